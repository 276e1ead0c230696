import { addSpring } from "../edit";
import type { Tool } from "./tool";

export const springTool: Tool = {
  id: "spring",
  label: "Spring",
  key: "f",
  hint: "From a point of one link to a point of another, or of the ground",
  icon: "M3 12 H6 L8 7 L11 17 L14 7 L17 17 L18.5 12 H21",
  takes: "way",
  preview: "line",
  act: ({ drawing, from, to }) => (from.point === undefined || to.point === undefined ? undefined : addSpring(drawing, from.point, to.point)),
};
