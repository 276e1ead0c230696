// What tools do to a mechanism file: the text in, the changed text out, all else as it was. Nothing comes back where there
// is nothing to do.
import type { Point } from "../data/answers";
import { appendItem, insertEntry, nodeAt, parseFile, removeAt, setValue, slotOf } from "../data/file_text";
import { carriers, drawingOf, isGround, placeOf, type Drawing, type TieType } from "./drawing";
import { nextJoint, nextLink, nextPoint, nextTie } from "./names";

/** A place that was pointed at: a point that is there, or a new one, perhaps on a link. */
export interface Spot {
  point?: string;
  link?: string;
  at: Point;
  /** The place as it is to be written, in the file's unit. */
  texts: [string, string];
  /** How far it is to be from where the hand began, where it was snapped to a length. */
  length?: string;
}

export type Edit = string | undefined;

const pair = ([x, y]: [string, string]): string => `[${x}, ${y}]`;

/** What an empty sheet begins with. */
export function newFile(length: string): string {
  return `format: 1\nname: New mechanism\nunits: {length: ${length}}\n`;
}

/** The same drawing after a change of its text; where constructions put points they stay. */
export function again(drawing: Drawing, text: string): Drawing {
  return drawingOf(text, Object.fromEntries(drawing.points.flatMap((one) => (one.at ? [[one.name, [...one.at]]] : []))));
}

/** A point at this place, of no link: it stands still. */
export function addPoint(drawing: Drawing, spot: Spot): string {
  return insertEntry(drawing.text, ["drawn"], nextPoint(drawing), pair(spot.texts));
}

/** The drawing with a point where the spot is, and its name: the one that is there or a new one, then also of the spot's link. */
export function withPoint(drawing: Drawing, spot: Spot): [Drawing, string] {
  if (spot.point !== undefined) return [withPlace(drawing, spot.point), spot.point];
  const name = nextPoint(drawing);
  const placed = again(drawing, addPoint(drawing, spot));
  return [spot.link === undefined ? placed : again(placed, appendItem(placed.text, ["links", spot.link, "points"], name)), name];
}

/** A point with a construction gets a place as well: from there new links are measured. */
function withPlace(drawing: Drawing, name: string): Drawing {
  const point = drawing.points.find((one) => one.name === name);
  if (!point?.at || point.section === "drawn" || point.fixed) return drawing;
  const texts = point.at.map((value) => String(Number((value / drawing.metres).toPrecision(10)))) as [string, string];
  return again(drawing, insertEntry(drawing.text, ["drawn"], name, pair(texts)));
}

/** Moves a point whose place is written as numbers, or as parameters that stand alone; a formula stays. */
export function movePoint(drawing: Drawing, name: string, texts: [string, string]): Edit {
  const point = drawing.points.find((one) => one.name === name);
  if (!point?.fixed) return undefined;
  const moved = texts.reduce((text, word, axis) => {
    const slot = slotOf(text, [point.section, name, axis]);
    return slot ? setValue(text, slot, word) : text;
  }, drawing.text);
  return moved === drawing.text ? undefined : moved;
}

/** A revolute joint of `link` at the point, with what is there: the ground where it stands still, else its first link. */
function pinned(drawing: Drawing, point: string, link: string): Drawing {
  const others = carriers(drawing, point).filter((one) => one.name !== link);
  const [first] = others;
  const from = first === undefined || isGround(drawing, point) ? "ground" : first.name;
  return addPin(drawing, point, from, link);
}

function addPin(drawing: Drawing, point: string, from: string, to: string): Drawing {
  return again(drawing, insertEntry(drawing.text, ["joints"], nextJoint(drawing, point), `{revolute: [${from}, ${to}], at: ${point}}`));
}

function addLinkOf(drawing: Drawing, points: string[], wanted: string, length?: string): [Drawing, string] {
  const name = nextLink(drawing, wanted);
  const given = length === undefined ? "" : `, length: ${length}`;
  return [again(drawing, insertEntry(drawing.text, ["links"], name, `{points: [${points.join(", ")}]${given}}`)), name];
}

/** A link from one spot to the other, pinned to whatever is at its ends. */
export function addLink(drawing: Drawing, from: Spot, to: Spot): Edit {
  if (from.point !== undefined && from.point === to.point) return undefined;
  if (from.point === undefined && to.point === undefined && from.texts.join() === to.texts.join()) return undefined;
  const still = [from, to].map((spot) => spot.point !== undefined && isGround(drawing, spot.point));
  if (still[0] && still[1]) return undefined;
  const known = from.point !== undefined && to.point !== undefined;
  if (known && drawing.links.some((link) => [from.point, to.point].every((point) => point !== undefined && link.points.includes(point)))) return undefined;
  const free = [from, to].map((spot) => spot.point === undefined && spot.link === undefined);
  const [one, a] = withPoint(drawing, from);
  const [two, b] = withPoint(one, to);
  const ends = still[1] ? [b, a] : [a, b]; // its direction counts from the ground
  const [linked, name] = addLinkOf(two, ends, ends.join(""), to.point === undefined ? to.length : undefined);
  const first = free[0] ? linked : pinned(linked, a, name);
  return (free[1] ? first : pinned(first, b, name)).text;
}

/** One more point of a link, which makes it a plate. */
export function addToLink(drawing: Drawing, link: string, spot: Spot): Edit {
  const own = drawing.links.find((one) => one.name === link);
  if (!own || (spot.point !== undefined && own.points.includes(spot.point))) return undefined;
  const [placed, name] = withPoint(drawing, { ...spot, link });
  if (spot.point === undefined) return placed.text;
  return pinned(again(placed, appendItem(placed.text, ["links", link, "points"], name)), name, link).text;
}

/** A pin on the ground: a new point, or an end of a link. */
export function addGroundPin(drawing: Drawing, spot: Spot): Edit {
  if (spot.point === undefined && spot.link === undefined) return addPoint(drawing, spot);
  const [placed, name] = withPoint(drawing, spot);
  const [link] = carriers(placed, name);
  if (!link || isGround(placed, name)) return undefined;
  return addPin(placed, name, "ground", link.name).text;
}

/** A pin between links that meet in a place: those of its point, and the ones that lie under it. */
export function addPinAt(drawing: Drawing, spot: Spot, under: string[]): Edit {
  const [first] = under;
  if (spot.point === undefined && first === undefined) return undefined;
  const [placed, name] = withPoint(drawing, { ...spot, ...(spot.point === undefined && first !== undefined ? { link: first } : {}) });
  let made = placed;
  for (const link of under)
    if (!carriers(made, name).some((one) => one.name === link)) made = again(made, appendItem(made.text, ["links", link, "points"], name));
  const links = carriers(made, name).map((one) => one.name);
  const joined = joinedAt(made, name, links[0] ?? "");
  for (const link of links) if (!joined.has(link)) made = addPin(made, name, links[0] ?? "ground", link);
  return made.text === drawing.text ? undefined : made.text;
}

/** The links that joints at this point hold together with one of them. */
function joinedAt(drawing: Drawing, point: string, link: string): Set<string> {
  const found = new Set([link]);
  const joints = drawing.joints.filter((one) => one.at === point && one.type !== "slot");
  for (let grown = true; grown;) {
    grown = false;
    for (const joint of joints) {
      if (found.has(joint.from) === found.has(joint.to)) continue;
      found.add(joint.from).add(joint.to);
      grown = true;
    }
  }
  return found;
}

export type Along = { axis: [string, string] } | { link: string };

function guideOf(drawing: Drawing, along: Along): { name: string; axis: [string, string] } | undefined {
  if ("axis" in along) return { name: "ground", axis: along.axis };
  const [a, b] = drawing.links.find((one) => one.name === along.link)?.points ?? [];
  return a === undefined || b === undefined ? undefined : { name: along.link, axis: [a, b] };
}

/** A block pinned to a point that slides along a direction of the ground, or along another link. */
export function addSlider(drawing: Drawing, point: string, along: Along): Edit {
  const holder = carriers(drawing, point)[0];
  const guide = guideOf(drawing, along);
  if (!holder || !guide || isGround(drawing, point) || carriers(drawing, point).some((one) => one.name === guide.name)) return undefined;
  const [blocked, block] = addLinkOf(drawing, [point], "block");
  const made = addPin(blocked, point, holder.name, block);
  return insertEntry(made.text, ["joints"], nextJoint(made, `S${point}`), `{prismatic: [${guide.name}, ${block}], at: ${point}, axis: ${pair(guide.axis)}}`);
}

/** A point of a link that runs in a slot of the ground, or along another link. */
export function addSlot(drawing: Drawing, point: string, along: Along): Edit {
  const holder = carriers(drawing, point)[0];
  const guide = guideOf(drawing, along);
  if (!holder || !guide || isGround(drawing, point) || carriers(drawing, point).some((one) => one.name === guide.name)) return undefined;
  const placed = withPlace(drawing, point);
  return insertEntry(placed.text, ["joints"], nextJoint(placed, `S${point}`), `{slot: [${guide.name}, ${holder.name}], at: ${point}, axis: ${pair(guide.axis)}}`);
}

/** What turns about a centre of two: the link that is pinned there and has not both; where nothing does, the ground if that is still and the other is not, or else a new wheel. */
function wheelAt(drawing: Drawing, point: string, other: string): [Drawing, string] {
  const own = carriers(drawing, point).find((one) => !one.points.includes(other) && drawing.joints.some((joint) => joint.type === "revolute" && joint.at === point && [joint.from, joint.to].includes(one.name)));
  if (own) return [drawing, own.name];
  if (isGround(drawing, point) && !isGround(drawing, other)) return [drawing, "ground"];
  const [made, name] = addLinkOf(drawing, [point], "wheel");
  const holder = carriers(drawing, point)[0];
  return [addPin(made, point, isGround(drawing, point) ? "ground" : (holder?.name ?? "ground"), name), name];
}

/** Two wheels with teeth, or two pulleys with a belt, about two centres: points that are there, or new pins of the ground. */
export function addWheels(drawing: Drawing, type: "gear" | "belt", from: Spot, to: Spot): Edit {
  if ([from, to].some((spot) => spot.point === undefined && spot.link !== undefined)) return undefined;
  if (from.point === to.point && (from.point !== undefined || from.texts.join() === to.texts.join())) return undefined;
  const [one, a] = withPoint(drawing, from);
  const [two, b] = withPoint(one, to);
  const [three, first] = wheelAt(two, a, b);
  const [four, second] = wheelAt(three, b, a);
  const [p, q] = [placeOf(four, a), placeOf(four, b)];
  if (first === second || !p || !q || four.ties.some((tie) => tie.type !== "cable" && tie.ends.includes(a) && tie.ends.includes(b))) return undefined;
  const radius = near(Math.hypot(q[0] - p[0], q[1] - p[1]) / four.metres / 4);
  return addTie(four, type, [first, second], [a, b], type === "gear" ? "teeth: [20, 20]" : `radii: [${radius}, ${radius}], tension: 100 N`);
}

function addTie(drawing: Drawing, type: TieType, links: [string, string], ends: [string, string], rest: string): string {
  const name = nextTie(drawing, type === "gear" ? "W" : type === "belt" ? "T" : "K");
  return insertEntry(drawing.text, ["joints"], name, `{${type}: ${pair(links)}, ${type === "cable" ? "at" : "centres"}: ${pair(ends)}, ${rest}}`);
}

/** A link that slides itself, and does not turn on its guide: along a direction of the ground, or along another link. */
export function addGuide(drawing: Drawing, link: string, spot: Spot, along: Along): Edit {
  const guide = guideOf(drawing, along);
  if (guide === undefined || guide.name === link) return undefined;
  const [placed, name] = withPoint(drawing, { ...spot, link });
  return insertEntry(placed.text, ["joints"], nextJoint(placed, `S${name}`), `{prismatic: [${guide.name}, ${link}], at: ${name}, axis: ${pair(guide.axis)}}`);
}

/** A cylinder at one spot and its rod at the other, which a motor pushes out. */
export function addCylinder(drawing: Drawing, from: Spot, to: Spot): Edit {
  if (from.point !== undefined && from.point === to.point) return undefined;
  const free = [from, to].map((spot) => spot.point === undefined && spot.link === undefined);
  const [one, a] = withPoint(drawing, from);
  const [two, b] = withPoint(one, to);
  const [halfway, cylinder] = addLinkOf(two, [a], "cylinder");
  const [both, rod] = addLinkOf(halfway, [b], "rod");
  let made = both;
  for (const [k, point, link] of [[0, a, cylinder], [1, b, rod]] as const)
    if (!free[k]) made = pinned(made, point, link);
  const name = nextJoint(made, `S${a}${b}`);
  made = again(made, insertEntry(made.text, ["joints"], name, `{prismatic: [${cylinder}, ${rod}], at: ${b}, axis: [${a}, ${b}]}`));
  return toggleMotor(made, name);
}

const near = (value: number): string => String(Number(value.toPrecision(3)));

/** A motor at a joint, or none any more. One that slides gets a range, and then all motors stand under `workspace`. */
export function toggleMotor(drawing: Drawing, name: string): Edit {
  const joint = drawing.joints.find((one) => one.name === name);
  if (!joint || !["revolute", "prismatic", "cylindrical"].includes(joint.type)) return undefined;
  const path = ["joints", name, "actuated"];
  if (joint.actuated) return removeAt(removeCoordinate(drawing, name).text, path);
  const text = setValue(drawing.text, path, "true");
  if (nodeAt(parseFile(drawing.text), ["workspace"]) === undefined && joint.type === "revolute") return text;
  const strokes = drawing.coordinates.some((one) => one.kind === "stroke" || one.range === undefined);
  const motors = drawing.coordinates.every((one) => one.range === undefined || (one.kind !== "place" && one.kind !== "other" && drawing.joints.some((own) => own.name === one.name)));
  // Where the coordinates are the motors' so far, the new one's is as well; where they are others they stay.
  return (strokes && motors) || drawing.coordinates.length === 0 ? writeCoordinate(again(drawing, writtenCoordinates(drawing, text)), name) : text;
}

/** The motors' own coordinates as they would be written. */
export function writtenCoordinates(drawing: Drawing, text = drawing.text): string {
  return drawing.coordinates.filter((one) => one.range === undefined).reduce((written, one) => insertEntry(written, ["workspace"], one.name, `{angle: [0 deg, 360 deg], of: ${one.from === undefined ? one.of : `[${one.from}, ${one.of}]`}}`), text);
}

/** The coordinate of a joint under `workspace`, with a range about where it is drawn. */
function writeCoordinate(drawing: Drawing, name: string): string {
  const joint = drawing.joints.find((one) => one.name === name);
  if (!joint) return drawing.text;
  if (joint.type === "revolute") return insertEntry(drawing.text, ["workspace"], name, `{angle: [0 deg, 360 deg], of: ${joint.from === "ground" ? joint.to : `[${joint.from}, ${joint.to}]`}}`);
  return insertEntry(drawing.text, ["workspace"], name, strokeText(drawing, name));
}

export function strokeText(drawing: Drawing, name: string): string {
  const joint = drawing.joints.find((one) => one.name === name);
  const at = joint && placeOf(drawing, joint.at);
  const first = joint && drawing.links.find((one) => one.name === joint.from)?.points[0];
  const from: Point | undefined = first === undefined ? [0, 0] : placeOf(drawing, first);
  const axis = joint?.axis ?? [1, 0];
  const out = at && from ? ((at[0] - from[0]) * axis[0] + (at[1] - from[1]) * axis[1]) / Math.hypot(...axis) / drawing.metres : 0;
  const half = Math.abs(out) > 0 && joint?.from !== "ground" ? Math.abs(out) / 2 : sizeOf(drawing) / drawing.metres / 2;
  return `{stroke: [${near(out - half)}, ${near(out + half)}], of: ${name}}`;
}

/** The greater side of all that is drawn, in m. */
export function sizeOf(drawing: Drawing): number {
  const places = drawing.points.flatMap((one) => (one.at ? [one.at] : []));
  const spans = ([0, 1] as const).map((axis) => Math.max(...places.map((at) => at[axis])) - Math.min(...places.map((at) => at[axis])));
  const size = Math.max(...spans);
  return Number.isFinite(size) && size > 0 ? size : 100 * drawing.metres;
}

export function removeCoordinate(drawing: Drawing, name: string): Drawing {
  return drawing.coordinates.some((one) => one.name === name && one.range !== undefined) ? again(drawing, removeAt(drawing.text, ["workspace", name])) : drawing;
}

/** Links of which two points are, other ones as far as there are. */
function linksBetween(drawing: Drawing, from: string, to: string): [string, string] | undefined {
  if (from === to || [from, to].every((point) => isGround(drawing, point))) return undefined;
  const linkOf = (point: string): string => (isGround(drawing, point) ? "ground" : carriers(drawing, point)[0]?.name ?? "ground");
  const others = (point: string, not: string): string => carriers(drawing, point).find((one) => one.name !== not)?.name ?? linkOf(point);
  const first = linkOf(from);
  const second = linkOf(to) === first ? others(to, first) : linkOf(to);
  return first === second ? undefined : [first, second];
}

/** A spring between two points of different links, or the ground. */
export function addSpring(drawing: Drawing, from: string, to: string): Edit {
  const links = linksBetween(drawing, from, to);
  if (!links) return undefined;
  const placed = again(drawing, withPlace(withPlace(drawing, from), to).text);
  return appendItem(placed.text, ["springs"], `{links: ${pair(links)}, at: [${from}, ${to}], stiffness: 1000 N/m, free_length: 0}`);
}

/** A cable between two points of different links, or the ground: it pulls. */
export function addCable(drawing: Drawing, from: string, to: string): Edit {
  const links = linksBetween(drawing, from, to);
  if (!links || drawing.ties.some((tie) => tie.type === "cable" && tie.ends.includes(from) && tie.ends.includes(to))) return undefined;
  const placed = again(drawing, withPlace(withPlace(drawing, from), to).text);
  return addTie(placed, "cable", links, [from, to], "tension: [0 N, 1000 N]");
}

/** The link on which a load at this point acts: the end effector's, else the last that was drawn there. */
export function loadedLink(drawing: Drawing, point: string): string | undefined {
  const own = carriers(drawing, point).map((one) => one.name);
  const end = drawing.endEffector;
  return end?.at === point && own.includes(end.link) ? end.link : own.at(-1);
}

export function setEndEffector(drawing: Drawing, point: string): Edit {
  const link = carriers(drawing, point).at(-1)?.name;
  if (link === undefined) return undefined;
  const text = drawing.endEffector ? removeAt(drawing.text, ["end_effector"]) : drawing.text;
  return insertEntry(text, [], "end_effector", `{link: ${link}, at: ${point}}`);
}

/** A force at a point, in the place of one that is there; without an end effector the point is it. */
export function setForce(drawing: Drawing, point: string, force: [string, string]): Edit {
  const link = loadedLink(drawing, point);
  if (link === undefined) return undefined;
  const index = drawing.loads.findIndex((one) => one.at === point && one.link === link && one.force);
  if (index >= 0) return setValue(drawing.text, ["loads", index, "force"], pair(force));
  const text = appendItem(drawing.text, ["loads"], `{link: ${link}, at: ${point}, force: ${pair(force)}}`);
  return drawing.endEffector ? text : setEndEffector(again(drawing, text), point);
}

/** Weight for a link; where there is none yet, gravity too. */
export function setMass(drawing: Drawing, link: string, mass: string): Edit {
  const text = setValue(drawing.text, ["links", link, "mass"], mass);
  return nodeAt(parseFile(text), ["gravity"]) === undefined ? insertEntry(text, [], "gravity", "[0, -9.81]") : text;
}
