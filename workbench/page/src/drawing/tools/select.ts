import { boxOf, setRangeEnd } from "../coordinates";
import { movePoint, type Edit } from "../edit";
import { setValue } from "../../data/file_text";
import { placeOf } from "../drawing";
import type { Grip } from "../grips";
import { angleText, strokeAlong } from "../grips";
import { forceOf, type Hand, type Tool } from "./tool";

export const selectTool: Tool = {
  id: "select",
  label: "Select",
  key: "v",
  hint: "Drag points, arrows and handles; click on an element to type its numbers",
  icon: "M5 3 L18 12 L12 13 L15 20 L12.5 21 L9.5 14 L5 18 Z",
  takes: "grip",
  act: ({ drawing, to, element }) => (element?.kind === "point" ? movePoint(drawing, element.name, to.texts) : undefined),
};

/** What the hand holds goes where the hand is. */
export function moveGrip(grip: Grip, hand: Hand): Edit {
  const { drawing, to } = hand;
  switch (grip.kind) {
    case "element":
      return selectTool.act({ ...hand, element: grip.element });
    case "arrow": {
      const tail = placeOf(drawing, drawing.loads[grip.index]?.at ?? "");
      if (!tail) return undefined;
      const [fx, fy] = forceOf(hand, tail, to.at);
      const text = [fx, fy].reduce((written, word, k) => setValue(written, ["loads", grip.index, "force", k], word), drawing.text);
      return text === drawing.text ? undefined : text;
    }
    case "corner": {
      const box = boxOf(drawing);
      if (!box) return undefined;
      return [box.x, box.y].reduce<Edit>((text, one, axis) => {
        const now = text === undefined ? drawing : { ...drawing, text };
        return setRangeEnd(now, one.name, grip.ends[axis as 0 | 1], to.texts[axis as 0 | 1]) ?? text;
      }, undefined);
    }
    case "range": {
      const own = drawing.coordinates.find((one) => one.name === grip.name);
      if (!own) return undefined;
      if (own.kind === "place") return setRangeEnd(drawing, own.name, grip.end, to.texts[own.axis]);
      return setRangeEnd(drawing, own.name, grip.end, own.kind === "angle" ? angleText(drawing, own, grip.end, to.at) : strokeAlong(drawing, own, to.at, hand.pixel));
    }
  }
}
