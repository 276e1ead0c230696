// What a press takes hold of: handles of ranges and of the box, tips of arrows, elements. Places in m; sizes in pixels.
import type { Point } from "../data/answers";
import { roundText } from "../data/exact";
import { distanceToSegment } from "../draw/pick";
import { boxOf } from "./coordinates";
import { placeOf, type Drawing, type DrawnCoordinate } from "./drawing";
import { sizeOf } from "./edit";
import type { Element } from "./element";
import { sides } from "./snap";

export type Grip =
  | { kind: "element"; element: Element }
  | { kind: "arrow"; index: number }
  | { kind: "corner"; ends: [0 | 1, 0 | 1] }
  | { kind: "range"; name: string; end: 0 | 1 };

export interface Handle {
  grip: Grip;
  at: Point;
}

/** Radii at which the ends of an angle's range have their handles, apart where they fall together. */
export const angleRadii: [number, number] = [40, 54];

/** Pixels of an arrow's length a newton: the largest force is an arrow of 80. */
export function arrowScale(drawing: Drawing): number {
  const largest = Math.max(0, ...drawing.loads.map((one) => (one.force ? Math.hypot(...one.force) : 0)));
  return largest > 0 ? 80 / largest : 1 / drawing.newtons;
}

/** Where the tip of a load's arrow is. */
export function tipOf(drawing: Drawing, index: number, pixel: number, scale: number): Point | undefined {
  const load = drawing.loads[index];
  const at = load && placeOf(drawing, load.at);
  if (!at || !load.force) return undefined;
  return [at[0] + load.force[0] * scale * pixel, at[1] + load.force[1] * scale * pixel];
}

/** Where a range's angle has its vertex and from which direction it counts. */
export function angleFrame(drawing: Drawing, own: DrawnCoordinate): { at: Point; zero: number } | undefined {
  const link = drawing.links.find((one) => one.name === own.of);
  const at = placeOf(drawing, link?.points[0] ?? "");
  if (!at) return undefined;
  const [a, b] = (drawing.links.find((one) => one.name === own.from)?.points ?? []).map((name) => placeOf(drawing, name));
  return { at, zero: a && b ? Math.atan2(b[1] - a[1], b[0] - a[0]) : 0 };
}

/** Along which line a stroke counts. */
export function strokeFrame(drawing: Drawing, own: DrawnCoordinate): { from: Point; axis: Point; at: Point } | undefined {
  const joint = drawing.joints.find((one) => one.name === own.of);
  const at = placeOf(drawing, joint?.at ?? "");
  const first = drawing.links.find((one) => one.name === joint?.from)?.points[0];
  const from: Point | undefined = joint?.from === "ground" ? [0, 0] : placeOf(drawing, first ?? "");
  if (!joint?.axis || !at || !from) return undefined;
  const size = Math.hypot(...joint.axis);
  return { from, axis: [joint.axis[0] / size, joint.axis[1] / size], at };
}

/** The place on the line of a stroke at this value. */
export function onStroke(frame: { from: Point; axis: Point; at: Point }, value: number): Point {
  const { from, axis, at } = frame;
  const out = (at[0] - from[0]) * axis[0] + (at[1] - from[1]) * axis[1];
  return [at[0] + (value - out) * axis[0], at[1] + (value - out) * axis[1]];
}

export function handlesOf(drawing: Drawing, pixel: number): Handle[] {
  const box = boxOf(drawing);
  const corners: Handle[] = box ? ([[0, 0], [1, 0], [1, 1], [0, 1]] as [0 | 1, 0 | 1][]).map((ends) => ({ grip: { kind: "corner", ends }, at: [ends[0] ? box.high[0] : box.low[0], ends[1] ? box.high[1] : box.low[1]] })) : [];
  const ranges = drawing.coordinates.flatMap((own): Handle[] => {
    const ends = [0, 1] as const;
    const value = (end: 0 | 1): number => (end ? own.high : own.low);
    const handle = (end: 0 | 1, at: Point): Handle => ({ grip: { kind: "range", name: own.name, end }, at });
    if (own.kind === "angle") {
      const frame = angleFrame(drawing, own);
      return frame ? ends.map((end) => handle(end, [frame.at[0] + angleRadii[end] * pixel * Math.cos(frame.zero + value(end)), frame.at[1] + angleRadii[end] * pixel * Math.sin(frame.zero + value(end))])) : [];
    }
    if (own.kind === "stroke") {
      const frame = strokeFrame(drawing, own);
      return frame ? ends.map((end) => handle(end, onStroke(frame, value(end)))) : [];
    }
    const at = own.kind === "place" && !box ? placeOf(drawing, own.of) : undefined;
    return at ? ends.map((end) => handle(end, own.axis === 0 ? [value(end), at[1]] : [at[0], value(end)])) : [];
  });
  return [...corners, ...ranges].filter((one) => one.at.every(Number.isFinite));
}

/** The angle to a place, in whole degrees, on the side of the range's other end. */
export function angleText(drawing: Drawing, own: DrawnCoordinate, end: 0 | 1, to: Point): string {
  const frame = angleFrame(drawing, own);
  if (!frame) return "0 deg";
  const degrees = Math.round(((Math.atan2(to[1] - frame.at[1], to[0] - frame.at[0]) - frame.zero) * 180) / Math.PI);
  const round = (value: number): number => Math.round((value * 180) / Math.PI);
  const before = round(end ? own.high : own.low);
  const other = round(end ? own.low : own.high);
  let value = degrees + 360 * Math.round((before - degrees) / 360);
  if (end && value <= other) value += 360;
  if (!end && value >= other) value -= 360;
  if (Math.abs(value - other) > 360) value = other + (end ? 360 : -360);
  return `${value} deg`;
}

export function strokeAlong(drawing: Drawing, own: DrawnCoordinate, to: Point, pixel: number): string {
  const frame = strokeFrame(drawing, own);
  const value = frame ? (to[0] - frame.from[0]) * frame.axis[0] + (to[1] - frame.from[1]) * frame.axis[1] : 0;
  return roundText(value / drawing.metres, (4 * pixel) / drawing.metres);
}

/** Where a joint's guide is drawn. */
export function guideOf(drawing: Drawing, name: string): { from: Point; to: Point; rail: boolean } | undefined {
  const joint = drawing.joints.find((one) => one.name === name);
  const at = joint && placeOf(drawing, joint.at);
  if (!at || !joint.axis || !["prismatic", "slot"].includes(joint.type)) return undefined;
  const holder = drawing.links.find((one) => one.name === joint.from);
  const first = placeOf(drawing, holder?.points[0] ?? "");
  if (joint.type === "prismatic" && holder?.points.length === 1 && first && holder.points[0] !== joint.at) return { from: first, to: at, rail: false };
  const half = (0.22 * sizeOf(drawing)) / Math.hypot(...joint.axis);
  return { from: [at[0] - half * joint.axis[0], at[1] - half * joint.axis[1]], to: [at[0] + half * joint.axis[0], at[1] + half * joint.axis[1]], rail: true };
}

/** What lies under a place, the smallest things first. */
export function elementAt(drawing: Drawing, at: Point, pixel: number): Element | undefined {
  const away = (place: Point | undefined): number => (place ? Math.hypot(place[0] - at[0], place[1] - at[1]) / pixel : Infinity);
  const nearest = drawing.points.map((one) => ({ one, away: away(one.at) })).sort((a, b) => a.away - b.away)[0];
  if (nearest && nearest.away <= 11) return { kind: "point", name: nearest.one.name };
  const scale = arrowScale(drawing);
  const load = drawing.loads.findIndex((one, k) => {
    const [tail, tip] = [placeOf(drawing, one.at), tipOf(drawing, k, pixel, scale)];
    return tail !== undefined && tip !== undefined && distanceToSegment(at, tail, tip) <= 6 * pixel;
  });
  if (load >= 0) return { kind: "load", index: load };
  const on = (a: Point | undefined, b: Point | undefined): boolean => a !== undefined && b !== undefined && distanceToSegment(at, a, b) <= 7 * pixel;
  const spring = drawing.springs.findIndex((one) => on(placeOf(drawing, one.at[0] ?? ""), placeOf(drawing, one.at[1] ?? "")));
  if (spring >= 0) return { kind: "spring", index: spring };
  const guide = drawing.joints.find((one) => {
    const line = guideOf(drawing, one.name);
    return line && on(line.from, line.to);
  });
  const tie = drawing.ties.find((one) => {
    const [a, b] = one.ends.map((name) => placeOf(drawing, name));
    const rim = one.type === "cable" ? [] : [a, b].map((centre, k) => Math.abs(away(centre) - one.radii[k as 0 | 1] / pixel));
    return (one.type === "cable" && on(a, b)) || rim.some((gap) => gap <= 6);
  });
  const link = drawing.links.filter((one) => sides(drawing, one.points).some(([a, b]) => on(a, b))).at(-1);
  if (link) return { kind: "link", name: link.name };
  if (tie) return { kind: "joint", name: tie.name };
  return guide && { kind: "joint", name: guide.name };
}

export function gripAt(drawing: Drawing, at: Point, pixel: number): Grip | undefined {
  const near = (place: Point | undefined, reach: number): boolean => place !== undefined && Math.hypot(place[0] - at[0], place[1] - at[1]) <= reach * pixel;
  const away = (place: Point | undefined): number => (place ? Math.hypot(place[0] - at[0], place[1] - at[1]) / pixel : Infinity);
  const [handle] = handlesOf(drawing, pixel).filter((one) => near(one.at, 8)).sort((a, b) => away(a.at) - away(b.at));
  if (handle) {
    // Those of an angle stand at so many pixels: who looks nearer finds them beside a point, which comes first.
    const { grip } = handle;
    const ofAngle = grip.kind === "range" && drawing.coordinates.some((own) => own.name === grip.name && own.kind === "angle");
    const nearest = Math.min(...drawing.points.map((one) => away(one.at)));
    if (nearest > away(handle.at) + (ofAngle ? 3 : -3)) return grip;
  }
  const scale = arrowScale(drawing);
  const element = elementAt(drawing, at, pixel);
  if (element?.kind !== "point") {
    const arrow = drawing.loads.findIndex((_, k) => near(tipOf(drawing, k, pixel, scale), 11));
    if (arrow >= 0) return { kind: "arrow", index: arrow };
  }
  return element && { kind: "element", element };
}
