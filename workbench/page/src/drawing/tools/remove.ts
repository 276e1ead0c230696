import { removeElement } from "../remove";
import type { Tool } from "./tool";

export const removeTool: Tool = {
  id: "remove",
  label: "Delete",
  key: "x",
  hint: "Removes the element that you click on, with everything that depends on it",
  icon: "M5 7 H19 M9 7 V4 H15 V7 M7 7 L8 20 H16 L17 7 M10 10 V17 M14 10 V17",
  takes: "place",
  act: ({ drawing, element }) => element && removeElement(drawing, element),
};
