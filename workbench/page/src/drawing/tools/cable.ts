import { addCable } from "../edit";
import type { Tool } from "./tool";

export const cableTool: Tool = {
  id: "cable",
  label: "Cable",
  key: "k",
  hint: "From a point of one link to a point of another, or of the ground: it pulls",
  icon: "M4 20 L20 4 M4 20 A1.5 1.5 0 1 0 4.1 20 M20 4 A1.5 1.5 0 1 0 20.1 4",
  takes: "way",
  preview: "line",
  act: ({ drawing, from, to }) => (from.point === undefined || to.point === undefined ? undefined : addCable(drawing, from.point, to.point)),
};
