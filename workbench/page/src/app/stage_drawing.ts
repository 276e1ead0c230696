// What the stage alone draws: the task, its verdict, the path of a linkage, a flash on the locus that is crossed.
import { reactionName, type Curve, type Point, type Theme, type Verdict } from "../data/answers";
import { colourOf, drawMarker, trace } from "../draw/loci";
import { page, type View } from "../draw/view";
import type { TaskState } from "./state";
import { handles, outline } from "./task_text";
import { parseExact, toNumber } from "../data/exact";
import type { Workbench } from "./workbench";

/** Of a task: green where it is verified, red where it is refuted, grey while it is not known. */
export function verdictColour(verdict: Verdict | undefined, theme: Theme): string {
  return !verdict || verdict.verdict === "undecided" ? theme.faded_ink : verdict.verified ? theme.verified : theme.failed;
}

/** Green and solid where it is verified, red and dashed where it is refuted, grey while it is not known. */
export function drawTask(context: CanvasRenderingContext2D, view: View, task: TaskState, verdict: Verdict | undefined, theme: Theme, metres: number): void {
  const colour = verdictColour(verdict, theme);
  const exact = parseExact(task.margin);
  const margin = exact ? toNumber(exact) * metres : 0;
  const line = outline(task.shape);
  context.save();
  context.lineJoin = "round";
  context.lineCap = "round";
  context.strokeStyle = colour;
  context.fillStyle = colour;
  context.beginPath();
  trace(context, view, line);
  context.globalAlpha = 0.16;
  if (task.shape.kind !== "path") context.fill();
  if (margin > 0) {
    context.lineWidth = 2 * margin * view.scale[0];
    context.stroke();
  }
  context.globalAlpha = 1;
  context.lineWidth = 2.2;
  context.setLineDash(verdict?.verified ? [] : [7, 5]);
  context.stroke();
  context.setLineDash([]);
  for (const handle of handles(task.shape)) {
    const at = page(view, handle);
    context.beginPath();
    context.rect(at[0] - 4, at[1] - 4, 8, 8);
    context.fillStyle = theme.paper;
    context.fill();
    context.lineWidth = 1.6;
    context.stroke();
  }
  context.restore();
}

export function drawWitness(context: CanvasRenderingContext2D, view: View, verdict: Verdict, theme: Theme): void {
  const at = verdict.verified ? verdict.nearest?.at : verdict.witness?.at;
  if (!at) return;
  const there = page(view, [at[0] ?? 0, at[1] ?? 0]);
  context.save();
  context.lineWidth = 4.5;
  context.strokeStyle = theme.paper;
  context.beginPath();
  context.arc(there[0], there[1], 7, 0, 2 * Math.PI);
  context.stroke();
  context.lineWidth = 2;
  context.strokeStyle = verdict.verified ? theme.verified : theme.failed;
  context.stroke();
  context.restore();
}

export function drawPoseCross(context: CanvasRenderingContext2D, at: Point, theme: Theme): void {
  context.save();
  context.lineWidth = 2;
  context.strokeStyle = theme.outline;
  context.fillStyle = theme.link;
  context.beginPath();
  context.arc(at[0], at[1], 7, 0, 2 * Math.PI);
  context.fill();
  context.stroke();
  context.beginPath();
  context.moveTo(at[0] - 13, at[1]);
  context.lineTo(at[0] + 13, at[1]);
  context.moveTo(at[0], at[1] - 13);
  context.lineTo(at[0], at[1] + 13);
  context.stroke();
  context.restore();
}

/** What vanishes on these curves: "f_A1, f_B1; direct singularity". */
export function crossingWords(curves: Curve[]): string {
  const words = new Set(curves.map((curve) => curve.vanishing.map(reactionName).join(", ") || curve.kind.replace("-", " ")));
  return [...words].join("; ");
}

export function drawFlash(context: CanvasRenderingContext2D, view: View, curves: Curve[], theme: Theme, left: number): void {
  context.save();
  context.globalAlpha = Math.max(0, left) * 0.55;
  context.lineWidth = 12;
  context.lineCap = "round";
  context.strokeStyle = theme.failed;
  for (const curve of curves) {
    context.beginPath();
    for (const arc of curve.arcs) trace(context, view, arc.points);
    context.stroke();
  }
  context.globalAlpha = Math.min(1, 2 * left);
  context.fillStyle = theme.failed;
  context.font = "700 15px system-ui, sans-serif";
  context.fillText(`crossed: ${crossingWords(curves)}`, 46, 26);
  context.restore();
}

/** The end effector's way over the cycle, with a mark where a reaction vanishes. */
export function drawPath(context: CanvasRenderingContext2D, view: View, bench: Workbench, theme: Theme): void {
  const { sweep, picture } = bench;
  if (!sweep || !picture) return;
  const places = sweep.answer.places;
  context.save();
  context.lineWidth = 1.6;
  context.strokeStyle = theme.frame;
  context.beginPath();
  let down = false;
  for (const place of places) {
    if (!place) {
      down = false;
      continue;
    }
    const at = page(view, [place[0] ?? 0, place[1] ?? 0]);
    if (down) context.lineTo(at[0], at[1]);
    else context.moveTo(at[0], at[1]);
    down = true;
  }
  context.stroke();
  context.restore();
  const hidden = new Set(bench.state.hidden);
  for (const group of picture.point_groups) {
    if (hidden.has(`${group.kind}|${group.what}|`)) continue;
    for (const index of group.points) {
      const value = picture.loci.isolated_points[index]?.at[0];
      const place = value === undefined ? undefined : placeAt(sweep.coordinate, places, value);
      if (place) drawMarker(context, page(view, place), group.shape, colourOf(theme, group.colour), theme);
    }
  }
}

/** Between two samples, straight. */
export function placeAt(values: readonly number[], places: readonly (number[] | null)[], value: number): Point | undefined {
  const after = values.findIndex((one) => one >= value);
  const k = after < 0 ? values.length - 1 : after;
  const [a, b] = [places[Math.max(0, k - 1)], places[k]];
  const [from, to] = [values[Math.max(0, k - 1)] ?? 0, values[k] ?? 0];
  const one = a ?? b;
  if (!one) return undefined;
  if (!a || !b || to === from) return [one[0] ?? 0, one[1] ?? 0];
  const t = (value - from) / (to - from);
  return [(a[0] ?? 0) + t * ((b[0] ?? 0) - (a[0] ?? 0)), (a[1] ?? 0) + t * ((b[1] ?? 0) - (a[1] ?? 0))];
}
