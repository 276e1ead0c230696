// Where a hand means to point: a point that is there, a line with one, a round length, the grid.
import type { Point } from "../data/answers";
import { parseExact, roundText, toNumber } from "../data/exact";
import { distanceToSegment } from "../draw/pick";
import type { Drawing } from "./drawing";
import type { Spot } from "./edit";

export interface Snapping {
  grid: boolean;
  lengths: boolean;
}

const pointReach = 11; // pixels
const lineReach = 5;
const linkReach = 7;

/** The least of 1, 2, 5 times a power of ten in the file's unit that is as wide as these pixels. */
export function gridStep(drawing: Drawing, pixel: number, pixels = 10): number {
  const least = (pixel * pixels) / drawing.metres;
  const power = 10 ** Math.floor(Math.log10(least));
  return ([1, 2, 5, 10].find((one) => one * power >= least * (1 - 1e-9)) ?? 10) * power;
}

/** `pixel`: how many m it is; `from`: where the hand began; `except`: a point that is moved itself. */
export function snap(drawing: Drawing, at: Point, pixel: number, how: Snapping, from?: Point, except?: string): Spot {
  const others = drawing.points.filter((one) => one.at && one.name !== except);
  const nearest = others.map((one) => ({ one, away: Math.hypot((one.at?.[0] ?? 0) - at[0], (one.at?.[1] ?? 0) - at[1]) })).sort((a, b) => a.away - b.away)[0];
  if (nearest?.one.at && nearest.away <= pointReach * pixel) return { point: nearest.one.name, at: nearest.one.at, texts: written(drawing, nearest.one.at) };
  const link = linkAt(drawing, at, pixel, except);
  if (how.lengths && from) {
    const round = onLength(drawing, at, pixel, from);
    if (round) return { ...round, ...(link === undefined ? {} : { link }) };
  }
  const step = how.grid ? gridStep(drawing, pixel) * drawing.metres : pixel;
  const lines = [...others.flatMap((one) => (one.at ? [one.at] : [])), ...(from ? [from] : [])];
  const snapped = ([0, 1] as const).map((axis) => {
    const line = lines.find((one) => Math.abs(one[axis] - at[axis]) <= lineReach * pixel);
    const onGrid = Math.round(at[axis] / step) * step;
    const value = line && (!how.grid || Math.abs(line[axis] - at[axis]) <= Math.abs(onGrid - at[axis])) ? line[axis] : undefined;
    return value === undefined ? roundText(onGrid / drawing.metres, step / drawing.metres) : exactText(value / drawing.metres);
  });
  const texts: [string, string] = [snapped[0] ?? "0", snapped[1] ?? "0"];
  return { at: [Number(texts[0]) * drawing.metres, Number(texts[1]) * drawing.metres], texts, ...(link === undefined ? {} : { link }) };
}

const exactText = (value: number): string => String(Number(value.toPrecision(12)) + 0);

const written = (drawing: Drawing, at: Point): [string, string] => [exactText(at[0] / drawing.metres), exactText(at[1] / drawing.metres)];

/** On the way from where the hand began, at the nearest round length or that of another link. */
function onLength(drawing: Drawing, at: Point, pixel: number, from: Point): Spot | undefined {
  const way = Math.hypot(at[0] - from[0], at[1] - from[1]);
  if (way < 4 * pixel) return undefined;
  const step = gridStep(drawing, pixel) * drawing.metres;
  const same = lengthsOf(drawing).find((one) => Math.abs(one.value - way) <= lineReach * pixel);
  const length = same?.value ?? Math.round(way / step) * step;
  if (length === 0) return undefined;
  const place: Point = [from[0] + ((at[0] - from[0]) * length) / way, from[1] + ((at[1] - from[1]) * length) / way];
  const texts = place.map((value) => roundText(value / drawing.metres, pixel / drawing.metres / 1000)) as [string, string];
  return { at: [Number(texts[0]) * drawing.metres, Number(texts[1]) * drawing.metres], texts, length: same?.text ?? roundText(length / drawing.metres, step / drawing.metres) };
}

/** Of links of two points, as given or as drawn. */
function lengthsOf(drawing: Drawing): { value: number; text: string }[] {
  return drawing.links.flatMap((link) => {
    const [a, b] = link.points.map((name) => drawing.points.find((one) => one.name === name)?.at);
    if (link.points.length !== 2 || !a || !b) return [];
    const drawn = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const given = parseExact(link.length ?? "");
    if (given && link.length !== undefined) return [{ value: toNumber(given) * drawing.metres, text: link.length }];
    return link.length === undefined ? [{ value: drawn, text: exactText(drawn / drawing.metres) }] : [];
  });
}

/** The link whose body lies under a place; of several the last drawn. */
export function linkAt(drawing: Drawing, at: Point, pixel: number, except?: string): string | undefined {
  return linksAt(drawing, at, pixel, except).at(-1);
}

export function linksAt(drawing: Drawing, at: Point, pixel: number, except?: string): string[] {
  return drawing.links.filter((link) => !(except !== undefined && link.points.includes(except)) && sides(drawing, link.points).some(([a, b]) => distanceToSegment(at, a, b) <= linkReach * pixel)).map((link) => link.name);
}

export function sides(drawing: Drawing, points: string[]): [Point, Point][] {
  const list = points.map((name) => drawing.points.find((one) => one.name === name)?.at).filter((at) => at !== undefined);
  const [first] = list;
  if (list.length > 2 && first) list.push(first);
  return list.slice(1).map((to, k) => [list[k] ?? to, to]);
}
