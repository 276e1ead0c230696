import { togglePlace, toggleAngle, toggleStroke } from "../coordinates";
import type { Tool } from "./tool";

export const freeTool: Tool = {
  id: "free",
  label: "Free coordinate",
  key: "q",
  hint: "Click on a link, slider or point: its angle, stroke or place becomes a free coordinate, or no longer; drag the handles of its range",
  icon: "M4 20 H20 M4 20 L16 6 M13 20 a9 9 0 0 0 -3.2 -6.8",
  takes: "place",
  act: ({ drawing, element, to, over }) => {
    if (element?.kind === "joint") return toggleStroke(drawing, element.name);
    if (to.point !== undefined) return togglePlace(drawing, to.point);
    const link = over.at(-1);
    return link === undefined ? undefined : toggleAngle(drawing, link);
  },
};
