import { carriers, isGround } from "../drawing";
import { setBox } from "../coordinates";
import type { Tool } from "./tool";

export const workspaceTool: Tool = {
  id: "workspace",
  label: "Workspace",
  key: "b",
  hint: "A box: the place of the end effector is free within it",
  icon: "M4 5 H20 V19 H4 Z M12 9 V15 M9 12 H15",
  takes: "way",
  preview: "box",
  act: ({ drawing, from, to }) => {
    const low = [0, 1].map((k) => (from.at[k as 0 | 1] <= to.at[k as 0 | 1] ? from : to).texts[k as 0 | 1]) as [string, string];
    const high = [0, 1].map((k) => (from.at[k as 0 | 1] <= to.at[k as 0 | 1] ? to : from).texts[k as 0 | 1]) as [string, string];
    const inside = drawing.points.filter((one) => one.at?.every((value, k) => (value - from.at[k as 0 | 1]) * (value - to.at[k as 0 | 1]) <= 0) && carriers(drawing, one.name).length > 0 && !isGround(drawing, one.name));
    const point = drawing.endEffector?.at ?? inside.at(-1)?.name;
    return point === undefined ? undefined : setBox(drawing, point, low, high);
  },
};
