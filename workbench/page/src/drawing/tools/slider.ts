import { addGuide, addSlider, type Along } from "../edit";
import type { Hand, Tool } from "./tool";

/** Along the link on which the hand lets go, else along its way; of a way along x or y the numbers say nothing. */
export function alongOf({ drawing, from, to, over }: Hand, own: string[]): Along | undefined {
  const link = over.find((name) => !own.includes(name));
  if (link !== undefined) return { link };
  const axis = [0, 1].map((k) => String(Number(((to.at[k as 0 | 1] - from.at[k as 0 | 1]) / drawing.metres).toPrecision(9)) + 0)) as [string, string];
  if (axis.every((one) => one === "0")) return undefined;
  return { axis: axis[0] === "0" ? ["0", "1"] : axis[1] === "0" ? ["1", "0"] : axis };
}

export const sliderTool: Tool = {
  id: "slider",
  label: "Slider",
  key: "s",
  hint: "From a point in the direction in which a block slides; from a link: the link slides; release on another link: along that link",
  icon: "M2 17 H22 M7 8 H17 V16 H7 Z",
  takes: "way",
  preview: "line",
  act: (hand) => {
    const { drawing, from } = hand;
    const own = from.point === undefined ? hand.under : drawing.links.filter((one) => one.points.includes(from.point ?? "")).map((one) => one.name);
    const along = alongOf(hand, own);
    if (!along) return undefined;
    if (from.point !== undefined) return addSlider(drawing, from.point, along);
    return from.link === undefined ? undefined : addGuide(drawing, from.link, from, along);
  },
};
