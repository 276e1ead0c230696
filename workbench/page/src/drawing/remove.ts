// Taking something away, with all that hangs on it.
import { insertEntry, removeAt, setValue, wordAt, type ValuePath } from "../data/file_text";
import { carriers, type Drawing } from "./drawing";
import { again, removeCoordinate, type Edit } from "./edit";
import type { Element } from "./element";
import { nextPoint } from "./names";

export function removeElement(drawing: Drawing, element: Element): Edit {
  const removed = remove(drawing, element).text;
  return removed === drawing.text ? undefined : removed;
}

function remove(drawing: Drawing, element: Element): Drawing {
  switch (element.kind) {
    case "point":
      return removePoint(drawing, element.name);
    case "link":
      return removeLink(drawing, element.name);
    case "joint":
      return unpin(drawing, element.name);
    case "load":
      return without(drawing, ["loads", element.index]);
    case "spring":
      return without(drawing, ["springs", element.index]);
    case "coordinate":
      return removeCoordinate(drawing, element.name);
  }
}

const without = (drawing: Drawing, path: ValuePath): Drawing => again(drawing, removeAt(drawing.text, path));

/** Again and again the first that is found, since places in lists shift. */
function each(drawing: Drawing, next: (drawing: Drawing) => Drawing | undefined): Drawing {
  for (let now = drawing; ;) {
    const then = next(now);
    if (!then || then.text === now.text) return now;
    now = then;
  }
}

function removeJoint(drawing: Drawing, name: string): Drawing {
  const strokes = drawing.coordinates.filter((one) => one.range !== undefined && (one.name === name || (one.kind === "stroke" && one.of === name)));
  const bare = strokes.reduce((left, one) => removeCoordinate(left, one.name), drawing);
  return without(bare, ["joints", name]);
}

/** A joint taken out from between links: what nothing holds there any more gets an end of its own. */
function unpin(drawing: Drawing, name: string): Drawing {
  const joint = drawing.joints.find((one) => one.name === name);
  const left = removeJoint(drawing, name);
  if (!joint || joint.from === "ground" || joint.to === "ground" || joint.type !== "revolute") return left;
  const loose = [joint.to, joint.from].find((link) => !left.joints.some((one) => one.at === joint.at && (one.from === link || one.to === link)));
  const index = left.links.find((one) => one.name === loose)?.points.indexOf(joint.at) ?? -1;
  const point = left.points.find((one) => one.name === joint.at);
  if (loose === undefined || index < 0 || point?.section !== "drawn") return left;
  const end = nextPoint(left);
  const texts = [0, 1].map((axis) => wordAt(left.text, ["drawn", joint.at, axis]) ?? "0");
  const placed = insertEntry(left.text, ["drawn"], end, `[${texts.join(", ")}]`);
  return again(left, setValue(placed, ["links", loose, "points", index], end));
}

/** Loads, springs, joints, coordinates and the end effector that name it. */
function removeUses(drawing: Drawing, uses: { link?: string; point?: string }): Drawing {
  const { link, point } = uses;
  const is = (name: string | undefined, own: string | undefined): boolean => own !== undefined && name === own;
  let left = each(drawing, (now) => {
    const joint = now.joints.find((one) => is(one.at, point) || is(one.from, link) || is(one.to, link));
    return joint && removeJoint(now, joint.name);
  });
  left = each(left, (now) => {
    const tie = now.ties.find((one) => one.ends.some((own) => is(own, point)) || is(one.from, link) || is(one.to, link));
    return tie && without(now, ["joints", tie.name]);
  });
  left = each(left, (now) => {
    const index = now.loads.findIndex((one) => is(one.at, point) || is(one.link, link));
    return index < 0 ? undefined : without(now, ["loads", index]);
  });
  left = each(left, (now) => {
    const index = now.springs.findIndex((one) => one.at.some((own) => is(own, point)) || one.links.some((own) => is(own, link)));
    return index < 0 ? undefined : without(now, ["springs", index]);
  });
  left = each(left, (now) => {
    const one = now.coordinates.find((own) => own.range !== undefined && ((own.kind === "place" && is(own.of, point)) || (own.kind === "angle" && (is(own.of, link) || is(own.from, link)))));
    return one && removeCoordinate(now, one.name);
  });
  const end = left.endEffector;
  return end && (is(end.at, point) || is(end.link, link)) ? without(left, ["end_effector"]) : left;
}

/** A link, its joints, and the points that no other link carries; where it was pinned to the ground the pin stays. */
function removeLink(drawing: Drawing, name: string): Drawing {
  const link = drawing.links.find((one) => one.name === name);
  if (!link) return drawing;
  const pins = new Set(drawing.joints.filter((one) => one.type === "revolute" && one.from === "ground" && one.to === name).map((one) => one.at));
  const left = without(removeUses(drawing, { link: name }), ["links", name]);
  const loose = link.points.filter((point) => carriers(left, point).length === 0 && !pins.has(point));
  return loose.reduce((now, point) => dropPlace(now, point), left);
}

function dropPlace(drawing: Drawing, point: string): Drawing {
  const bare = removeUses(drawing, { point });
  return without(without(bare, ["drawn", point]), ["points", point]);
}

/** A point, and the links of which too little is left. */
function removePoint(drawing: Drawing, name: string): Drawing {
  let left = removeUses(drawing, { point: name });
  for (const link of carriers(drawing, name)) {
    const own = left.links.find((one) => one.name === link.name);
    if (!own) continue;
    left = own.points.length <= 2 ? removeLink(left, link.name) : without(left, ["links", link.name, "points", own.points.indexOf(name)]);
  }
  return dropPlace(left, name);
}
