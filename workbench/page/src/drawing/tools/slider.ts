import { addSlider } from "../edit";
import type { Tool } from "./tool";

export const sliderTool: Tool = {
  id: "slider",
  label: "Slider",
  key: "s",
  hint: "From a point along the way it slides; released on a link, it slides along that",
  icon: "M2 17 H22 M7 8 H17 V16 H7 Z",
  takes: "way",
  preview: "line",
  act: ({ drawing, from, to, over }) => {
    if (from.point === undefined) return undefined;
    const guide = over.find((name) => !drawing.links.find((one) => one.name === name)?.points.includes(from.point ?? ""));
    if (guide !== undefined) return addSlider(drawing, from.point, { link: guide });
    const axis = [0, 1].map((k) => String(Number(((to.at[k as 0 | 1] - from.at[k as 0 | 1]) / drawing.metres).toPrecision(9)) + 0)) as [string, string];
    if (axis.every((one) => one === "0")) return undefined;
    // Along x or y the numbers of the way say nothing.
    const plain = axis[0] === "0" ? (["0", "1"] as [string, string]) : axis[1] === "0" ? (["1", "0"] as [string, string]) : axis;
    return addSlider(drawing, from.point, { axis: plain });
  },
};
