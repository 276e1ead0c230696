import { addSlot } from "../edit";
import { alongOf } from "./slider";
import type { Tool } from "./tool";

export const slotTool: Tool = {
  id: "slot",
  label: "Slot",
  key: "o",
  hint: "From a point of a link in the direction of a slot of the ground; release on another link: the slot is along that link",
  icon: "M7 7 H17 A5 5 0 0 1 17 17 H7 A5 5 0 0 1 7 7 M10 12 A2 2 0 1 0 14 12 A2 2 0 1 0 10 12",
  takes: "way",
  preview: "line",
  act: (hand) => {
    const { drawing, from } = hand;
    if (from.point === undefined) return undefined;
    const point = from.point;
    const along = alongOf(hand, drawing.links.filter((one) => one.points.includes(point)).map((one) => one.name));
    return along && addSlot(drawing, point, along);
  },
};
