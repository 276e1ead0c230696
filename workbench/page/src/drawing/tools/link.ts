import { addLink } from "../edit";
import type { Tool } from "./tool";

export const linkTool: Tool = {
  id: "link",
  label: "Link",
  key: "l",
  hint: "Two clicks, or press and release: a link, pinned to the elements at its ends",
  icon: "M5 19 L19 5 M5 16 a3 3 0 1 0 .1 0 M19 2 a3 3 0 1 0 .1 0",
  takes: "way",
  preview: "line",
  act: ({ drawing, from, to }) => addLink(drawing, from, to),
};
