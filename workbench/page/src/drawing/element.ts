// An element of a drawing: what is pointed at, selected, named by a refusal.
import type { Point } from "../data/answers";
import type { ValuePath } from "../data/file_text";
import { placeOf, type Drawing } from "./drawing";

export type Element =
  | { kind: "point" | "link" | "joint" | "coordinate"; name: string }
  | { kind: "load" | "spring"; index: number };

export function sameElement(one: Element | undefined, other: Element | undefined): boolean {
  return JSON.stringify(one) === JSON.stringify(other);
}

const sections: Record<string, "point" | "link" | "joint" | "coordinate" | "load" | "spring"> = { drawn: "point", points: "point", links: "link", joints: "joint", workspace: "coordinate", loads: "load", springs: "spring" };

/** What of the drawing stands at a place of its file. */
export function elementOf(path: ValuePath): Element | undefined {
  const [section, key] = path;
  const kind = typeof section === "string" ? sections[section] : undefined;
  if (kind === undefined || key === undefined) return undefined;
  if (kind === "load" || kind === "spring") return typeof key === "number" ? { kind, index: key } : undefined;
  return { kind, name: String(key) };
}

/** Where it stands in the file. */
export function pathOf(drawing: Drawing, element: Element): ValuePath {
  switch (element.kind) {
    case "point":
      return [drawing.points.find((one) => one.name === element.name)?.section ?? "drawn", element.name];
    case "link":
      return ["links", element.name];
    case "joint":
      return ["joints", element.name];
    case "coordinate":
      return ["workspace", element.name];
    case "load":
      return ["loads", element.index];
    case "spring":
      return ["springs", element.index];
  }
}

/** Whether it is there still. */
export function isThere(drawing: Drawing, element: Element): boolean {
  switch (element.kind) {
    case "point":
      return drawing.points.some((one) => one.name === element.name);
    case "link":
      return drawing.links.some((one) => one.name === element.name);
    case "joint":
      return [...drawing.joints, ...drawing.ties].some((one) => one.name === element.name);
    case "coordinate":
      return drawing.coordinates.some((one) => one.name === element.name);
    case "load":
      return element.index < drawing.loads.length;
    case "spring":
      return element.index < drawing.springs.length;
  }
}

function middle(places: (Point | undefined)[]): Point | undefined {
  const known = places.filter((one) => one !== undefined);
  if (known.length === 0) return undefined;
  return [known.reduce((sum, at) => sum + at[0], 0) / known.length, known.reduce((sum, at) => sum + at[1], 0) / known.length];
}

/** Where one looks for it, in m. */
export function placeOfElement(drawing: Drawing, element: Element): Point | undefined {
  const at = (name: string): Point | undefined => placeOf(drawing, name);
  switch (element.kind) {
    case "point":
      return at(element.name);
    case "link":
      return middle((drawing.links.find((one) => one.name === element.name)?.points ?? []).map(at));
    case "joint":
      return at(drawing.joints.find((one) => one.name === element.name)?.at ?? "") ?? middle((drawing.ties.find((one) => one.name === element.name)?.ends ?? []).map(at));
    case "load":
      return at(drawing.loads[element.index]?.at ?? "");
    case "spring":
      return middle((drawing.springs[element.index]?.at ?? []).map(at));
    case "coordinate": {
      const own = drawing.coordinates.find((one) => one.name === element.name);
      if (!own) return undefined;
      if (own.kind === "place") return at(own.of);
      return placeOfElement(drawing, { kind: own.kind === "stroke" ? "joint" : "link", name: own.of });
    }
  }
}
