// What a mechanism file draws, as a picture and tools need it: points with their places, links, joints, loads, springs,
// coordinates. Lengths are in m, angles in rad, forces in N; what is written stays at hand as text.
import { isMap, isScalar, isSeq, type Document, type Node } from "yaml";
import type { Point } from "../data/answers";
import { evaluate } from "../data/expression";
import { nodeAt, parseFile, type ValuePath } from "../data/file_text";
import { unitSizes, unitsOf, type Units } from "../data/units";

export interface DrawnPoint {
  name: string;
  at: Point | undefined;
  /** "drawn": its place; "points": a construction. */
  section: "drawn" | "points";
  /** Whether its numbers are its place, wherever the mechanism is. */
  fixed: boolean;
}
export interface DrawnLink {
  name: string;
  points: string[];
  length: string | undefined;
  mass: string | undefined;
}
export interface DrawnJoint {
  name: string;
  type: string;
  from: string;
  to: string;
  at: string;
  /** In the drawn posture; of a joint that slides. */
  axis: Point | undefined;
  actuated: boolean;
}
/** What joins two links at two points: a gear or a belt about its wheels' centres, a cable between its ends. */
export interface DrawnTie {
  name: string;
  type: TieType;
  from: string;
  to: string;
  ends: [string, string];
  /** Of wheels their pitch circles, in m. */
  radii: [number, number];
}
export type TieType = "gear" | "belt" | "cable";
export interface DrawnLoad {
  link: string;
  at: string;
  force: Point | undefined;
}
export interface DrawnSpring {
  links: string[];
  at: string[];
  joint: string | undefined;
}
export interface DrawnCoordinate {
  name: string;
  kind: "angle" | "place" | "stroke" | "other";
  /** A link, a point or a joint; of an angle from another link also that. */
  of: string;
  from: string | undefined;
  axis: 0 | 1;
  low: number;
  high: number;
  /** Where its range stands; nothing where it is a motor's own. */
  range: ValuePath | undefined;
}
export interface Drawing {
  text: string;
  name: string;
  units: Units;
  /** How many m, N a plain number is. */
  metres: number;
  newtons: number;
  spatial: boolean;
  points: DrawnPoint[];
  links: DrawnLink[];
  joints: DrawnJoint[];
  ties: DrawnTie[];
  loads: DrawnLoad[];
  springs: DrawnSpring[];
  coordinates: DrawnCoordinate[];
  parameters: { name: string; text: string }[];
  endEffector: { link: string; at: string } | undefined;
}

/** Reads a file's nodes without complaint: what is not understood is absent. */
class Reader {
  private readonly document: Document.Parsed;
  readonly units: Units;

  constructor(readonly text: string) {
    this.document = parseFile(text);
    const said = (key: string): string | undefined => this.word(["units", key]);
    this.units = unitsOf(this.node(["units"]) ? { length: said("length"), angle: said("angle"), force: said("force") } : undefined);
  }
  node(path: ValuePath): Node | undefined {
    return nodeAt(this.document, path);
  }
  names(path: ValuePath): string[] {
    const map = this.node(path);
    return isMap(map) ? map.items.flatMap((pair) => (isScalar(pair.key) ? [String(pair.key.value)] : [])) : [];
  }
  word(path: ValuePath): string | undefined {
    const node = this.node(path);
    return isScalar(node) ? String(node.value) : undefined;
  }
  /** The scalars of a list; nothing where one of them is something else. */
  words(path: ValuePath): string[] | undefined {
    const node = this.node(path);
    if (!isSeq(node)) return undefined;
    const words = node.items.map((item) => (isScalar(item) ? String(item.value) : undefined));
    return words.every((word) => word !== undefined) ? words : undefined;
  }
  items(path: ValuePath): number[] {
    const node = this.node(path);
    return isSeq(node) ? node.items.map((_, k) => k) : [];
  }
  /** `size`: how much of SI a plain number is. */
  number(text: string | undefined, size: number, names = new Set<string>()): number {
    if (text === undefined) return NaN;
    const value = evaluate(text, (name) => {
      if (name === "pi") return Math.PI;
      const parameter = this.word(["parameters", name]);
      if (parameter !== undefined && !names.has(name)) return this.number(parameter, size, new Set([...names, name])) / size;
      const unit = unitSizes[name];
      return unit === undefined ? undefined : unit / size;
    });
    return value * size;
  }
  place(words: string[] | undefined, size: number): Point | undefined {
    if (words?.length !== 2) return undefined;
    const at: Point = [this.number(words[0], size), this.number(words[1], size)];
    return at.every(Number.isFinite) ? at : undefined;
  }
}

/** `posture`: where the points of constructions are, by name. */
export function drawingOf(text: string, posture: Record<string, number[]> = {}): Drawing {
  const reader = new Reader(text);
  const metres = reader.word(["units", "length"]) === undefined ? 1 : reader.units.length.size;
  const newtons = reader.word(["units", "force"]) === undefined ? 1 : reader.units.force.size;
  const points = pointsOf(reader, metres, posture);
  const placeOf = (name: string): Point | undefined => points.find((one) => one.name === name)?.at;
  const links = reader.names(["links"]).map((name) => {
    const path = ["links", name];
    return { name, points: reader.words([...path, "points"]) ?? [], length: reader.word([...path, "length"]), mass: reader.word([...path, "mass"]) };
  });
  const joints = reader.names(["joints"]).flatMap((name) => jointOf(reader, name, placeOf) ?? []);
  const end = { link: reader.word(["end_effector", "link"]), at: reader.word(["end_effector", "at"]) };
  return {
    text,
    name: reader.word(["name"]) ?? "",
    units: reader.units,
    metres,
    newtons,
    spatial: reader.word(["space"]) === "spatial",
    points,
    links,
    joints,
    ties: reader.names(["joints"]).flatMap((name) => tieOf(reader, name, metres, placeOf) ?? []),
    loads: reader.items(["loads"]).map((k) => ({ link: reader.word(["loads", k, "link"]) ?? "", at: reader.word(["loads", k, "at"]) ?? "", force: reader.place(reader.words(["loads", k, "force"]), newtons) })),
    springs: reader.items(["springs"]).map((k) => ({ links: reader.words(["springs", k, "links"]) ?? [], at: reader.words(["springs", k, "at"]) ?? [], joint: reader.word(["springs", k, "joint"]) })),
    coordinates: coordinatesOf(reader, joints, metres),
    parameters: reader.names(["parameters"]).map((name) => ({ name, text: reader.word(["parameters", name]) ?? "" })),
    endEffector: end.link !== undefined && end.at !== undefined ? { link: end.link, at: end.at } : undefined,
  };
}

function pointsOf(reader: Reader, metres: number, posture: Record<string, number[]>): DrawnPoint[] {
  const drawn = reader.names(["drawn"]).map((name): DrawnPoint => ({ name, at: reader.place(reader.words(["drawn", name]), metres), section: "drawn", fixed: true }));
  const named = new Set(drawn.map((one) => one.name));
  const built = reader.names(["points"]).filter((name) => !named.has(name)).map((name): DrawnPoint => {
    const own = reader.place(reader.words(["points", name]), metres);
    const [x, y] = posture[name] ?? [];
    return { name, at: own ?? (x === undefined || y === undefined ? undefined : [x, y]), section: "points", fixed: own !== undefined };
  });
  return [...drawn, ...built];
}

function jointOf(reader: Reader, name: string, placeOf: (name: string) => Point | undefined): DrawnJoint | undefined {
  const path = ["joints", name];
  const type = reader.names(path).find((key) => ["revolute", "prismatic", "universal", "spherical", "cylindrical", "slot"].includes(key));
  const [from, to] = (type && reader.words([...path, type])) ?? [];
  if (!type || from === undefined || to === undefined) return undefined;
  const axis = reader.words([...path, "axis"]);
  const [tail, tip] = (axis ?? []).map(placeOf);
  const direction = tail && tip ? ([tip[0] - tail[0], tip[1] - tail[1]] as Point) : reader.place(axis, 1);
  const actuated = reader.node([...path, "actuated"]);
  return { name, type, from, to, at: reader.word([...path, "at"]) ?? "", axis: direction, actuated: isMap(actuated) || (isScalar(actuated) && actuated.value === "true") };
}

function tieOf(reader: Reader, name: string, metres: number, placeOf: (name: string) => Point | undefined): DrawnTie | undefined {
  const path = ["joints", name];
  const type = (["gear", "belt", "cable"] as const).find((one) => reader.node([...path, one]) !== undefined);
  if (!type) return undefined;
  const [from, to] = reader.words([...path, type]) ?? [];
  const [a, b] = reader.words([...path, type === "cable" ? "at" : "centres"]) ?? [];
  if (from === undefined || to === undefined || a === undefined || b === undefined) return undefined;
  const [p, q] = [placeOf(a), placeOf(b)];
  const sizes = (reader.words([...path, type === "gear" ? "teeth" : "radii"]) ?? []).map((word) => reader.number(word, type === "gear" ? 1 : metres));
  const [first = NaN, second = NaN] = sizes;
  // The teeth share the way between the centres; a ring, of a negative number, is around its pinion.
  const tooth = p && q ? Math.hypot(q[0] - p[0], q[1] - p[1]) / Math.abs(first + second) : NaN;
  return { name, type, from, to, ends: [a, b], radii: type === "gear" ? [Math.abs(first) * tooth, Math.abs(second) * tooth] : [Math.abs(first), Math.abs(second)] };
}

function coordinatesOf(reader: Reader, joints: DrawnJoint[], metres: number): DrawnCoordinate[] {
  const angles = reader.word(["units", "angle"]) === undefined ? 1 : reader.units.angle.size;
  const names = reader.names(["workspace"]);
  if (names.length === 0 && reader.names(["drawn"]).length > 0) {
    const motors = joints.filter((joint) => joint.actuated && joint.type === "revolute");
    return motors.map((joint) => ({ name: joint.name, kind: "angle", of: joint.from === "ground" ? joint.to : joint.from === joint.to ? "" : joint.to, from: joint.from === "ground" ? undefined : joint.from, axis: 0, low: 0, high: 2 * Math.PI, range: undefined }));
  }
  return names.map((name) => {
    const path = ["workspace", name];
    const key = ["angle", "stroke", "within"].find((one) => reader.node([...path, one]) !== undefined);
    const range = key === undefined ? path : [...path, key];
    const pair = reader.words([...path, "of"]);
    const of = reader.word([...path, "of"]) ?? pair?.[1];
    const place = reader.word([...path, "place"]);
    const kind = of === undefined ? "other" : key === "angle" ? "angle" : key === "stroke" ? "stroke" : place === undefined ? "other" : "place";
    const [low, high] = (reader.words(range) ?? []).map((word) => reader.number(word, key === "angle" ? angles : metres));
    return { name, kind, of: of ?? "", from: pair?.[0], axis: place === "y" ? 1 : 0, low: low ?? NaN, high: high ?? NaN, range };
  });
}

export const placeOf = (drawing: Drawing, point: string): Point | undefined => drawing.points.find((one) => one.name === point)?.at;

/** Whether all of the mechanism stands here; of copies of a pattern and of points without a name only the program knows. */
export function isWhole(drawing: Drawing): boolean {
  const known = new Set(drawing.points.flatMap((one) => (one.at ? [one.name] : [])));
  return !/^repeat:/m.test(drawing.text) && drawing.links.every((link) => link.points.length > 0 && link.points.every((name) => known.has(name))) && drawing.joints.every((joint) => known.has(joint.at) && (!["prismatic", "slot"].includes(joint.type) || joint.axis !== undefined));
}

export const carriers = (drawing: Drawing, point: string): DrawnLink[] => drawing.links.filter((link) => link.points.includes(point));

/** Whether a point stands still: of no link, or pinned to the ground. */
export function isGround(drawing: Drawing, point: string): boolean {
  if (carriers(drawing, point).length === 0) return true;
  return drawing.joints.some((joint) => joint.at === point && joint.type === "revolute" && (joint.from === "ground" || joint.to === "ground"));
}

/** The coordinates of the posture that is drawn; nothing where one of them measures something else. */
export function drawnPose(drawing: Drawing): number[] | undefined {
  const turn = (link: string): number => {
    const [from, to] = (drawing.links.find((one) => one.name === link)?.points ?? []).map((point) => placeOf(drawing, point));
    return from && to ? Math.atan2(to[1] - from[1], to[0] - from[0]) : NaN;
  };
  const values = drawing.coordinates.map((one) => {
    if (one.kind === "place") return placeOf(drawing, one.of)?.[one.axis] ?? NaN;
    if (one.kind === "stroke") return strokeOf(drawing, one.of);
    if (one.kind !== "angle") return NaN;
    const angle = turn(one.of) - (one.from === undefined || one.from === "ground" ? 0 : turn(one.from));
    const round = 2 * Math.PI;
    const turns = Math.ceil((one.low - angle) / round - 1e-12);
    return Number.isFinite(turns) ? angle + round * turns : angle;
  });
  return values.length > 0 && values.every(Number.isFinite) ? values : undefined;
}

/** From the first point of the link that carries the guide, or the origin of the ground, to the joint's point. */
export function strokeOf(drawing: Drawing, name: string): number {
  const joint = drawing.joints.find((one) => one.name === name);
  const at = joint && placeOf(drawing, joint.at);
  if (!joint?.axis || !at) return NaN;
  const first = drawing.links.find((link) => link.name === joint.from)?.points[0];
  const from = joint.from === "ground" ? ([0, 0] as Point) : first === undefined ? undefined : placeOf(drawing, first);
  if (!from) return NaN;
  return ((at[0] - from[0]) * joint.axis[0] + (at[1] - from[1]) * joint.axis[1]) / Math.hypot(...joint.axis);
}
