// Where a place of the plane stands on the canvas.
import type { Point } from "../data/answers";
import type { Unit } from "../data/units";

export interface Size {
  width: number;
  height: number;
}

/** `scale`: pixels a unit along x and y; y runs up. `origin`: the canvas' place of (0, 0). */
export interface View {
  scale: Point;
  origin: Point;
}

export interface Box {
  low: Point;
  high: Point;
}

export function page(view: View, at: Point): Point {
  return [view.origin[0] + at[0] * view.scale[0], view.origin[1] - at[1] * view.scale[1]];
}

export function plane(view: View, at: Point): Point {
  return [(at[0] - view.origin[0]) / view.scale[0], (view.origin[1] - at[1]) / view.scale[1]];
}

/** The whole box amid the canvas. `square`: one scale for both axes, as lengths want it. */
export function fit(box: Box, size: Size, square: boolean, margin = 34): View {
  const width = Math.max(box.high[0] - box.low[0], 1e-12);
  const height = Math.max(box.high[1] - box.low[1], 1e-12);
  let sx = Math.max(size.width - 2 * margin, 20) / width;
  let sy = Math.max(size.height - 2 * margin, 20) / height;
  if (square) sx = sy = Math.min(sx, sy);
  return {
    scale: [sx, sy],
    origin: [
      size.width / 2 - ((box.low[0] + box.high[0]) / 2) * sx,
      size.height / 2 + ((box.low[1] + box.high[1]) / 2) * sy,
    ],
  };
}

/** Nearer by the factor, with the place under the pointer where it is. */
export function zoomed(view: View, at: Point, factor: number): View {
  const along = (axis: 0 | 1): number => at[axis] + (view.origin[axis] - at[axis]) * factor;
  return { scale: [view.scale[0] * factor, view.scale[1] * factor], origin: [along(0), along(1)] };
}

export function moved(view: View, by: Point): View {
  return { scale: view.scale, origin: [view.origin[0] + by[0], view.origin[1] + by[1]] };
}

/** Values from low to high that are round in their unit, some `apart` pixels from each other; degrees at their own. */
export function ticks(low: number, high: number, scale: number, apart: number, shown: Unit): number[] {
  const unit = shown.size;
  const angle = shown.name === "deg";
  const least = apart / scale / unit;
  const power = 10 ** Math.floor(Math.log10(least));
  const steps = angle && least > 1 ? [5, 10, 15, 30, 45, 90, 180, 360] : [power, 2 * power, 5 * power, 10 * power];
  const step = steps.find((one) => one >= least) ?? steps[steps.length - 1] ?? 1;
  const list: number[] = [];
  for (let k = Math.ceil(low / unit / step - 1e-9); k * step * unit <= high && list.length < 200; ++k)
    list.push(k * step * unit + 0);
  return list;
}

export function tickText(value: number, shown: Unit): string {
  return String(Number((value / shown.size).toPrecision(6)) + 0);
}
