import { setEndEffector } from "../edit";
import type { Tool } from "./tool";

export const endEffectorTool: Tool = {
  id: "effector",
  label: "End effector",
  key: "e",
  hint: "The point of a link whose place counts",
  icon: "M12 2 V22 M2 12 H22 M12 6 a6 6 0 1 0 .1 0",
  takes: "place",
  act: ({ drawing, to }) => (to.point === undefined || drawing.endEffector?.at === to.point ? undefined : setEndEffector(drawing, to.point)),
};
