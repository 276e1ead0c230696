// Which coordinates are free, and how far they go.
import type { Point } from "../data/answers";
import { insertEntry, removeAt, setValue } from "../data/file_text";
import { carriers, isGround, placeOf, type Drawing, type DrawnCoordinate } from "./drawing";
import { again, loadedLink, removeCoordinate, setEndEffector, sizeOf, strokeText, writtenCoordinates, type Edit } from "./edit";
import { nextCoordinate } from "./names";

/** The place of a point over a box is what is free, and nothing else. */
export function setBox(drawing: Drawing, point: string, low: [string, string], high: [string, string]): Edit {
  if (!carriers(drawing, point)[0] || isGround(drawing, point)) return undefined;
  if (low[0] === high[0] || low[1] === high[1]) return undefined;
  const bare = again(drawing, removeAt(drawing.text, ["workspace"]));
  const text = (["x", "y"] as const).reduce((written, axis, k) => insertEntry(written, ["workspace"], axis, `{place: ${axis}, of: ${point}, within: [${low[k] ?? ""}, ${high[k] ?? ""}]}`), bare.text);
  return drawing.endEffector || loadedLink(drawing, point) === undefined ? text : setEndEffector(again(drawing, text), point);
}

/** The coordinates that are written, as the motors' own are not. */
function written(drawing: Drawing): Drawing {
  return drawing.coordinates.some((one) => one.range !== undefined) ? drawing : again(drawing, removeAt(drawing.text, ["workspace"]));
}

/** The direction of a link is free, or not any more. */
export function toggleAngle(drawing: Drawing, link: string): Edit {
  const own = drawing.coordinates.find((one) => one.kind === "angle" && one.of === link && one.range !== undefined);
  if (own) return removeCoordinate(drawing, own.name).text;
  if ((drawing.links.find((one) => one.name === link)?.points.length ?? 0) < 2) return undefined;
  const base = written(drawing);
  return insertEntry(base.text, ["workspace"], nextCoordinate(base, ["theta", "phi", "psi"]), `{angle: [0 deg, 360 deg], of: ${link}}`);
}

/** The stroke of a slider is free, or not any more. */
export function toggleStroke(drawing: Drawing, joint: string): Edit {
  const own = drawing.coordinates.find((one) => one.kind === "stroke" && one.of === joint && one.range !== undefined);
  if (own) return removeCoordinate(drawing, own.name).text;
  const base = written(drawing);
  return insertEntry(base.text, ["workspace"], nextCoordinate(base, ["s", "t", "u"]), strokeText(drawing, joint));
}

/** The place of a point is free, in a box about where it is drawn, or not any more. */
export function togglePlace(drawing: Drawing, point: string): Edit {
  const own = drawing.coordinates.filter((one) => one.kind === "place" && one.of === point);
  if (own.length > 0) return own.reduce((left, one) => removeCoordinate(left, one.name), drawing).text;
  const at = placeOf(drawing, point);
  if (!at) return undefined;
  const half = sizeOf(drawing) / 4;
  const texts = (sign: number): [string, string] => at.map((value) => String(Number(((value + sign * half) / drawing.metres).toPrecision(3)))) as [string, string];
  return setBox(drawing, point, texts(-1), texts(1));
}

/** One end of a coordinate's range; the motors' own are written first. */
export function setRangeEnd(drawing: Drawing, name: string, end: 0 | 1, text: string): Edit {
  const known = drawing.coordinates.find((one) => one.name === name);
  if (!known) return undefined;
  const base = known.range === undefined ? again(drawing, writtenCoordinates(drawing)) : drawing;
  const range = base.coordinates.find((one) => one.name === name)?.range;
  if (!range) return undefined;
  const changed = setValue(base.text, [...range, end], text);
  return changed === drawing.text ? undefined : changed;
}

/** The box of two places of one point, if that is what is free. */
export function boxOf(drawing: Drawing): { point: string; low: Point; high: Point; x: DrawnCoordinate; y: DrawnCoordinate } | undefined {
  const x = drawing.coordinates.find((one) => one.kind === "place" && one.axis === 0);
  const y = drawing.coordinates.find((one) => one.kind === "place" && one.axis === 1);
  if (!x || !y || x.of !== y.of) return undefined;
  return { point: x.of, low: [x.low, y.low], high: [x.high, y.high], x, y };
}
