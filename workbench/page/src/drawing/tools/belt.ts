import { addWheels } from "../edit";
import type { Tool } from "./tool";

export const beltTool: Tool = {
  id: "belt",
  label: "Belt",
  key: "h",
  hint: "From the centre of one pulley to that of the other; a click on a pulley shows the radii, of which the second is negative where the belt is crossed",
  icon: "M6 8 H18 A4 4 0 0 1 18 16 H6 A4 4 0 0 1 6 8 M6 12 H6.1 M18 12 H18.1",
  takes: "way",
  preview: "line",
  act: ({ drawing, from, to }) => addWheels(drawing, "belt", from, to),
};
