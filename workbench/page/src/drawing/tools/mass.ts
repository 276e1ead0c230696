import { setMass } from "../edit";
import type { Tool } from "./tool";

export const massTool: Tool = {
  id: "mass",
  label: "Mass",
  key: "w",
  hint: "On a link: a mass of 1 kg, with gravity; type another on the link",
  icon: "M8 8 H16 L20 20 H4 Z M12 3 a2.5 2.5 0 1 0 .1 0",
  takes: "place",
  act: ({ drawing, to, over }) => {
    const link = over.at(-1) ?? (to.point === undefined ? undefined : drawing.links.find((one) => one.points.includes(to.point ?? ""))?.name);
    return link === undefined || drawing.links.find((one) => one.name === link)?.mass !== undefined ? undefined : setMass(drawing, link, "1");
  },
};
