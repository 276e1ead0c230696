import { addCylinder } from "../edit";
import type { Tool } from "./tool";

export const cylinderTool: Tool = {
  id: "cylinder",
  label: "Cylinder",
  key: "c",
  hint: "From where the cylinder is pinned to the end of its rod: a motor pushes it out",
  icon: "M3 21 L8 16 M5.5 13.5 L10.5 18.5 L17 12 L12 7 Z M15 9 L21 3",
  takes: "way",
  preview: "line",
  act: ({ drawing, from, to }) => addCylinder(drawing, from, to),
};
