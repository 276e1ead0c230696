// Names for what is drawn: letters for points, their ends for links.
import type { Drawing } from "./drawing";

/** The first of these names that is free. */
export function firstFree(taken: Iterable<string>, name: (k: number) => string): string {
  const names = new Set(taken);
  let k = 0;
  while (names.has(name(k))) ++k;
  return name(k);
}

/** "E", "P" and the like are free for points where no joint or coordinate is called so. */
export function nextPoint(drawing: Drawing): string {
  const taken = [...drawing.points, ...drawing.joints, ...drawing.ties, ...drawing.links, ...drawing.coordinates, ...drawing.parameters].map((one) => one.name);
  return firstFree(taken, (k) => String.fromCharCode(65 + (k % 26)) + (k < 26 ? "" : String(Math.floor(k / 26))));
}

export function nextLink(drawing: Drawing, wanted: string): string {
  const taken = [...drawing.links.map((one) => one.name), "ground"];
  return firstFree(taken, (k) => (k === 0 ? wanted : `${wanted}_${k + 1}`));
}

export function nextJoint(drawing: Drawing, wanted: string): string {
  return firstFree([...drawing.joints, ...drawing.ties].map((one) => one.name), (k) => (k === 0 ? wanted : `${wanted}_${k + 1}`));
}

/** The pitch point of a gear has its name. */
export function nextTie(drawing: Drawing, wanted: string): string {
  const taken = [...drawing.joints, ...drawing.ties, ...drawing.points, ...drawing.coordinates, ...drawing.parameters].map((one) => one.name);
  return firstFree(taken, (k) => (k === 0 ? wanted : `${wanted}_${k + 1}`));
}

export function nextCoordinate(drawing: Drawing, wanted: string[]): string {
  const taken = [...drawing.coordinates, ...drawing.points, ...drawing.parameters].map((one) => one.name);
  return firstFree(taken, (k) => wanted[k] ?? `q${k - wanted.length + 1}`);
}
