import { addWheels } from "../edit";
import type { Tool } from "./tool";

export const gearTool: Tool = {
  id: "gear",
  label: "Gear",
  key: "t",
  hint: "From the centre of one wheel to that of the other: what is pinned there turns with its wheel; a click on the rim shows the teeth",
  icon: "M3 12 A5 5 0 1 0 13 12 A5 5 0 1 0 3 12 M13 12 A4 4 0 1 0 21 12 A4 4 0 1 0 13 12 M8 12 H8.1 M17 12 H17.1",
  takes: "way",
  preview: "line",
  act: ({ drawing, from, to }) => addWheels(drawing, "gear", from, to),
};
