import { addPinAt } from "../edit";
import type { Tool } from "./tool";

export const pinTool: Tool = {
  id: "pin",
  label: "Pin",
  key: "n",
  hint: "Where links meet or cross: a pin between them; on one link: a point of it",
  icon: "M12 6 a6 6 0 1 0 .1 0 M12 10 a2 2 0 1 0 .1 0",
  takes: "place",
  act: ({ drawing, to, over }) => addPinAt(drawing, to, over),
};
