// A tool is data and what it does to the drawing: one file, and one line of tools/list.ts.
import type { Point } from "../../data/answers";
import type { Drawing } from "../drawing";
import type { Edit, Spot } from "../edit";
import type { Element } from "../element";

/** What the hand did: pressed at `from`, released at `to`; for a tool that takes one place both are it. */
export interface Hand {
  drawing: Drawing;
  from: Spot;
  to: Spot;
  /** What lay under `from`. */
  element: Element | undefined;
  /** All links under `from`, and under `to`. */
  under: string[];
  over: string[];
  /** How many m a pixel is, and N a pixel of a force's arrow. */
  pixel: number;
  arrow: number;
}

export interface Tool {
  id: string;
  label: string;
  /** The letter that takes it up. */
  key: string;
  hint: string;
  /** A path in a box of 24. */
  icon: string;
  /** A place, or a way by two clicks or one drag; with "grip" the hand holds what it presses on. */
  takes: "place" | "way" | "grip";
  /** What follows the hand on its way. */
  preview?: "line" | "arrow" | "box";
  act: (hand: Hand) => Edit;
}

/** An arrow as the force it stands for, in round numbers of the file's unit. */
export function forceOf(hand: Hand, tail: Point, tip: Point): [string, string] {
  const { drawing, pixel, arrow } = hand;
  const round = (way: number): number => {
    const size = ((way / pixel) * arrow) / drawing.newtons;
    const step = niceStep((5 * arrow) / drawing.newtons);
    return Math.round(size / step) * step;
  };
  return [tip[0] - tail[0], tip[1] - tail[1]].map((way) => String(Number(round(way).toPrecision(6)) + 0)) as [string, string];
}

function niceStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return ([1, 2, 5, 10].find((one) => one * power >= least * (1 - 1e-9)) ?? 10) * power;
}
