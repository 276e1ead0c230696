import { placeOf } from "../drawing";
import { setForce } from "../edit";
import { forceOf, type Tool } from "./tool";

export const forceTool: Tool = {
  id: "force",
  label: "Force",
  key: "r",
  hint: "From a point of a link: its arrow; the first one marks the end effector",
  icon: "M12 3 V18 M6 13 L12 20 L18 13",
  takes: "way",
  preview: "arrow",
  act: (hand) => {
    const { drawing, from, to } = hand;
    const tail = from.point === undefined ? undefined : placeOf(drawing, from.point);
    if (from.point === undefined || !tail) return undefined;
    const force = forceOf(hand, tail, to.at);
    return force.every((one) => one === "0") ? undefined : setForce(drawing, from.point, force);
  },
};
