// A task as its file says it (docs: clearloci verify).
import type { TaskShape, TaskState } from "./state";

/** What the free coordinates are called, which of them are angles, and what m are where the file has units of its own. */
export interface TaskCoordinates {
  names: readonly string[];
  angles?: readonly boolean[];
  unit?: string;
}

export function taskText(task: TaskState, coordinates: TaskCoordinates): string {
  const lines = ["format: 1", shapeLine(task.shape, coordinates)];
  if (task.margin) lines.push(`margin: ${task.margin}`);
  if (task.minForce) lines.push(`min_force: ${task.minForce}`);
  if (task.minCouple) lines.push(`min_couple: ${task.minCouple}`);
  if (task.loads) lines.push(`loads_from: ${task.loads}`);
  if (task.tolerances) lines.push(`tolerances: ${within("{", task.tolerances, "}")}`);
  if (task.loadsWithin) lines.push(`loads_within: ${within("[", task.loadsWithin, "]")}`);
  return `${lines.join("\n")}\n`;
}

/** YAML's brackets need not be typed. */
function within(open: string, typed: string, close: string): string {
  return typed.startsWith(open) && typed.endsWith(close) ? typed : `${open}${typed}${close}`;
}

function shapeLine(shape: TaskShape, { names, angles = [], unit = "" }: TaskCoordinates): string {
  const short = (value: number): number => Number(value.toPrecision(9));
  const length = (value: number): string => `${short(value)}${unit && ` ${unit}`}`;
  const number = (value: number, axis: number): string => (angles[axis] ? `${short((value * 180) / Math.PI)} deg` : length(value));
  const pair = (point: readonly [number, number]): string => `[${number(point[0], 0)}, ${number(point[1], 1)}]`;
  switch (shape.kind) {
    case "box":
    case "ranges":
      return `box: {${shape.low.map((from, k) => `${names[k] ?? "xy"[k] ?? ""}: ${range(number(from, k), number(shape.high[k] ?? from, k))}`).join(", ")}}`;
    case "circle":
      return `circle: {centre: ${pair(shape.centre)}, radius: ${length(shape.radius)}}`;
    default:
      return `${shape.kind}: [${shape.points.map(pair).join(", ")}]`;
  }
}

/** A coordinate that is held has no range. */
function range(from: string, to: string): string {
  return from === to ? from : `[${from}, ${to}]`;
}

export function movedShape(shape: TaskShape, by: readonly [number, number]): TaskShape {
  const move = (at: readonly [number, number]): [number, number] => [at[0] + by[0], at[1] + by[1]];
  switch (shape.kind) {
    case "box":
      return { ...shape, low: move(shape.low), high: move(shape.high) };
    case "circle":
      return { ...shape, centre: move(shape.centre) };
    case "ranges":
      return shape; // it is moved by its ends
    default:
      return { ...shape, points: shape.points.map(move) };
  }
}

/** The points by which a hand changes the shape. */
export function handles(shape: TaskShape): [number, number][] {
  switch (shape.kind) {
    case "box":
      return [shape.low, [shape.high[0], shape.low[1]], shape.high, [shape.low[0], shape.high[1]]];
    case "circle":
      return [[shape.centre[0] + shape.radius, shape.centre[1]]];
    case "ranges":
      return [];
    default:
      return shape.points;
  }
}

export function withHandle(shape: TaskShape, index: number, to: [number, number]): TaskShape {
  switch (shape.kind) {
    case "box": {
      const opposite = handles(shape)[(index + 2) % 4] ?? shape.low;
      const low: [number, number] = [Math.min(to[0], opposite[0]), Math.min(to[1], opposite[1])];
      return { ...shape, low, high: [Math.max(to[0], opposite[0]), Math.max(to[1], opposite[1])] };
    }
    case "circle":
      return { ...shape, radius: Math.max(1e-6, Math.hypot(to[0] - shape.centre[0], to[1] - shape.centre[1])) };
    case "ranges":
      return shape;
    default:
      return { ...shape, points: shape.points.map((point, k) => (k === index ? to : point)) };
  }
}

/** The outline as a polygon or, of a path, as it is. */
export function outline(shape: TaskShape): [number, number][] {
  if (shape.kind === "box") return [...handles(shape), shape.low];
  if (shape.kind === "circle") {
    const steps = 64;
    return Array.from({ length: steps + 1 }, (_, k): [number, number] => {
      const turn = (2 * Math.PI * k) / steps;
      return [shape.centre[0] + shape.radius * Math.cos(turn), shape.centre[1] + shape.radius * Math.sin(turn)];
    });
  }
  if (shape.kind === "ranges") return [];
  const first = shape.points[0];
  return shape.kind === "polygon" && first ? [...shape.points, first] : shape.points;
}

export type DrawnKind = Exclude<TaskShape["kind"], "ranges">;

/** What a drag from one place to another draws; nothing yet where they are one. */
export function drawnShape(kind: DrawnKind, from: [number, number], to: [number, number]): TaskShape | undefined {
  const low: [number, number] = [Math.min(from[0], to[0]), Math.min(from[1], to[1])];
  const high: [number, number] = [Math.max(from[0], to[0]), Math.max(from[1], to[1])];
  const flat = low[0] === high[0] || low[1] === high[1];
  switch (kind) {
    case "box":
      return flat ? undefined : { kind, low, high };
    case "circle": {
      const radius = Math.hypot(to[0] - from[0], to[1] - from[1]);
      return radius > 0 ? { kind, centre: from, radius: Number(radius.toPrecision(4)) } : undefined;
    }
    case "polygon":
      return flat ? undefined : { kind, points: [low, [high[0], low[1]], high, [low[0], high[1]]] };
    case "path":
      return from[0] === to[0] && from[1] === to[1] ? undefined : { kind, points: [from, to] };
  }
}

/** Whether a place is in a task, or on its line within `reach`. */
export function taskHit(shape: TaskShape, at: readonly [number, number], reach: number): boolean {
  if (shape.kind === "ranges") return false;
  if (shape.kind === "circle") return Math.hypot(at[0] - shape.centre[0], at[1] - shape.centre[1]) <= shape.radius;
  if (shape.kind === "box")
    return at[0] >= shape.low[0] && at[0] <= shape.high[0] && at[1] >= shape.low[1] && at[1] <= shape.high[1];
  return shape.points.some((point, k) => {
    const next = shape.points[(k + 1) % shape.points.length];
    if (!next || (shape.kind === "path" && k + 1 === shape.points.length)) return false;
    const length = Math.hypot(next[0] - point[0], next[1] - point[1]) || 1;
    const t = Math.min(1, Math.max(0, ((at[0] - point[0]) * (next[0] - point[0]) + (at[1] - point[1]) * (next[1] - point[1])) / length ** 2));
    return Math.hypot(at[0] - point[0] - t * (next[0] - point[0]), at[1] - point[1] - t * (next[1] - point[1])) <= reach;
  });
}
