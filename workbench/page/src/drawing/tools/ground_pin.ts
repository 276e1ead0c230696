import { addGroundPin } from "../edit";
import type { Tool } from "./tool";

export const groundPinTool: Tool = {
  id: "ground",
  label: "Ground pin",
  key: "g",
  hint: "A pin on the ground: on the empty sheet, or at the end of a link",
  icon: "M12 4 L6 15 L18 15 Z M3 16 H21 M6 16 l-3 4 M11 16 l-3 4 M16 16 l-3 4 M21 16 l-3 4",
  takes: "place",
  act: ({ drawing, to }) => addGroundPin(drawing, to),
};
