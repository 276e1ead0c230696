import { carriers } from "../drawing";
import { addToLink } from "../edit";
import type { Tool } from "./tool";

export const plateTool: Tool = {
  id: "plate",
  label: "Plate",
  key: "p",
  hint: "From a link to one more point of it",
  icon: "M4 19 L20 19 L11 5 Z",
  takes: "way",
  preview: "line",
  act: ({ drawing, from, to, element }) => {
    const link = element?.kind === "link" ? element.name : from.link ?? (from.point === undefined ? undefined : carriers(drawing, from.point).at(-1)?.name);
    return link === undefined ? undefined : addToLink(drawing, link, to);
  },
};
