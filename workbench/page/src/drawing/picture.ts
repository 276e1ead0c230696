// A drawing on a canvas: the mechanism in the posture that is drawn, what is free, what is held.
import type { Point, Sketch, Theme } from "../data/answers";
import { shortNumber } from "../data/exact";
import { drawArrow, drawNames, drawSketch, drawSprings } from "../draw/mechanism";
import { page, type View } from "../draw/view";
import { boxOf } from "./coordinates";
import { carriers, isGround, placeOf, type Drawing } from "./drawing";
import { sameElement, type Element } from "./element";
import { angleFrame, angleRadii, guideOf, handlesOf, onStroke, strokeFrame, tipOf } from "./grips";
import { sides } from "./snap";

/** As the pictures know mechanisms; pins of no link yet stand on the ground. */
export function sketchOf(drawing: Drawing): Sketch {
  const pins = drawing.joints.flatMap((joint) => {
    const at = placeOf(drawing, joint.at);
    return at && joint.type !== "prismatic" ? [{ name: joint.at, at, on_ground: (joint.from === "ground" && joint.type !== "slot") || joint.to === "ground", actuated: joint.actuated }] : [];
  });
  const waiting = drawing.points.flatMap((point) => (point.at && carriers(drawing, point.name).length === 0 ? [{ name: point.name, at: point.at, on_ground: true, actuated: false }] : []));
  const slides = drawing.joints.flatMap((joint) => guideOf(drawing, joint.name) ?? []);
  const places = (names: string[]): Point[] => names.map((name) => placeOf(drawing, name)).filter((at) => at !== undefined);
  return {
    links: drawing.links.map((link) => ({ name: link.name, points: places(link.points) })),
    slides,
    joints: [...pins.filter((one) => !one.actuated), ...waiting, ...pins.filter((one) => one.actuated)],
    loads: [],
    springs: drawing.springs.flatMap((spring) => {
      const [from, to] = places(spring.at);
      return from && to ? [{ from, to, torsion: false, from_ground: spring.links[0] === "ground", to_ground: spring.links[1] === "ground" }] : [];
    }),
    gravity: [0, 0],
  };
}

/** Every place that is to be seen, in m. */
export function extentOf(drawing: Drawing): Point[] {
  const box = boxOf(drawing);
  const rims = drawing.ties.filter((tie) => tie.type !== "cable").flatMap((tie) => tie.ends.flatMap((name, k): Point[] => {
    const at = placeOf(drawing, name);
    const radius = tie.radii[k as 0 | 1];
    return at ? [[at[0] - radius, at[1] - radius], [at[0] + radius, at[1] + radius]] : [];
  }));
  return [...drawing.points.flatMap((one) => (one.at ? [one.at] : [])), ...rims, ...(box ? [box.low, box.high] : [])].filter((at) => at.every(Number.isFinite));
}

function ring(context: CanvasRenderingContext2D, at: Point, radius: number, stroke: string, fill?: string): void {
  context.beginPath();
  context.arc(at[0], at[1], radius, 0, 2 * Math.PI);
  if (fill !== undefined) {
    context.fillStyle = fill;
    context.fill();
  }
  context.strokeStyle = stroke;
  context.stroke();
}

function words(context: CanvasRenderingContext2D, text: string, at: Point, colour: string, theme: Theme): void {
  context.font = "11px system-ui, sans-serif";
  context.lineWidth = 3;
  context.strokeStyle = theme.paper;
  context.strokeText(text, at[0], at[1]);
  context.fillStyle = colour;
  context.fillText(text, at[0], at[1]);
}

function drawBlocks(context: CanvasRenderingContext2D, view: View, drawing: Drawing, theme: Theme): void {
  for (const joint of drawing.joints) {
    const at = placeOf(drawing, joint.at);
    const guide = guideOf(drawing, joint.name);
    if (!at || !joint.axis || !guide?.rail || joint.type === "slot") continue;
    const there = page(view, at);
    context.save();
    context.translate(...there);
    context.rotate(-Math.atan2(joint.axis[1], joint.axis[0]));
    context.strokeStyle = theme.outline;
    context.lineWidth = 1.5;
    context.strokeRect(-15, -9, 30, 18);
    if (joint.actuated) drawArrow(context, [-9, 0], [10, 0], theme.outline, 1.6);
    context.restore();
  }
}

/** The rims of slots, as long as their rails. */
function drawSlots(context: CanvasRenderingContext2D, view: View, drawing: Drawing, theme: Theme): void {
  const half = 7;
  context.strokeStyle = theme.outline;
  context.lineWidth = 1.2;
  for (const joint of drawing.joints) {
    const guide = joint.type === "slot" ? guideOf(drawing, joint.name) : undefined;
    if (!guide) continue;
    const [from, to] = [page(view, guide.from), page(view, guide.to)];
    context.save();
    context.translate(...from);
    context.rotate(Math.atan2(to[1] - from[1], to[0] - from[0]));
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    context.beginPath();
    context.arc(0, 0, half, Math.PI / 2, (3 * Math.PI) / 2);
    context.arc(length, 0, half, -Math.PI / 2, Math.PI / 2);
    context.closePath();
    context.stroke();
    context.restore();
  }
}

/** Pitch circles of wheels, with a mark a tooth where these are far enough apart; belts around theirs; cables. */
function drawTies(context: CanvasRenderingContext2D, view: View, drawing: Drawing, theme: Theme, selected: Element | undefined): void {
  for (const tie of drawing.ties) {
    const [a, b] = tie.ends.map((name) => placeOf(drawing, name));
    if (!a || !b) continue;
    const [from, to] = [page(view, a), page(view, b)];
    context.save();
    context.strokeStyle = theme.outline;
    context.lineWidth = sameElement(selected, { kind: "joint", name: tie.name }) ? 3 : 1.3;
    if (tie.type === "cable") {
      context.beginPath();
      context.moveTo(...from);
      context.lineTo(...to);
      context.stroke();
    } else {
      const radii = tie.radii.map((radius) => radius * Math.abs(view.scale[0]));
      if (radii.every(Number.isFinite)) [from, to].forEach((at, k) => drawWheel(context, at, radii[k] ?? 0, tie.type === "gear"));
      if (tie.type === "belt") drawSpans(context, from, to, [radii[0] ?? 0, radii[1] ?? 0]);
    }
    context.restore();
  }
}

function drawWheel(context: CanvasRenderingContext2D, at: Point, radius: number, teeth: boolean): void {
  context.setLineDash(teeth ? [3, 3] : []);
  context.beginPath();
  context.arc(at[0], at[1], radius, 0, 2 * Math.PI);
  context.stroke();
  context.setLineDash([]);
}

/** Both spans: from where a belt leaves one pulley to where it meets the other, by the angle that the difference of the radii turns them. */
function drawSpans(context: CanvasRenderingContext2D, from: Point, to: Point, radii: [number, number]): void {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const cosine = (radii[0] - radii[1]) / length;
  if (!(Math.abs(cosine) <= 1)) return;
  const along = Math.atan2(to[1] - from[1], to[0] - from[0]);
  for (const side of [1, -1]) {
    const turn = along + side * Math.acos(cosine);
    context.beginPath();
    context.moveTo(from[0] + radii[0] * Math.cos(turn), from[1] + radii[0] * Math.sin(turn));
    context.lineTo(to[0] + radii[1] * Math.cos(turn), to[1] + radii[1] * Math.sin(turn));
    context.stroke();
  }
}

function drawForces(context: CanvasRenderingContext2D, view: View, drawing: Drawing, scale: number, theme: Theme, selected: Element | undefined): void {
  drawing.loads.forEach((load, index) => {
    const at = placeOf(drawing, load.at);
    const tip = tipOf(drawing, index, 1 / view.scale[0], scale);
    if (!at || !tip || !load.force) return;
    const end = page(view, tip);
    drawArrow(context, page(view, at), end, theme.load, sameElement(selected, { kind: "load", index }) ? 4 : 2.4);
    const told = `${shortNumber(Math.hypot(...load.force) / drawing.newtons)} ${drawing.units.force.name}`;
    context.textAlign = load.force[0] < 0 ? "right" : "left"; // beyond the tip, not on the arrow
    words(context, told, [end[0] + (load.force[0] < 0 ? -7 : 7), end[1] + 4], theme.load, theme);
    context.textAlign = "left";
  });
}

/** Lengths that are given, and masses, on their links. */
function drawSizes(context: CanvasRenderingContext2D, view: View, drawing: Drawing, theme: Theme, selected: Element | undefined): void {
  for (const link of drawing.links) {
    const [a, b] = link.points.map((name) => placeOf(drawing, name));
    const chosen = sameElement(selected, { kind: "link", name: link.name });
    if (!a) continue;
    const at = page(view, b ? [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] : a);
    const length = b && link.points.length === 2 ? `${link.length ?? shortNumber(Math.hypot(b[0] - a[0], b[1] - a[1]) / drawing.metres, 5)} ${drawing.units.declared ? drawing.units.length.name : "m"}` : "";
    const told = [link.length !== undefined || chosen ? length : "", link.mass === undefined ? "" : `${link.mass} kg`].filter(Boolean).join(", ");
    if (told) words(context, told, [at[0] + 8, at[1] + 14], theme.ink, theme);
  }
}

function highlight(context: CanvasRenderingContext2D, view: View, drawing: Drawing, element: Element, colour: string): void {
  context.save();
  context.strokeStyle = colour;
  context.lineCap = "round";
  context.lineWidth = 16;
  context.globalAlpha = 0.28;
  const line = (a: Point | undefined, b: Point | undefined): void => {
    if (!a || !b) return;
    context.beginPath();
    context.moveTo(...page(view, a));
    context.lineTo(...page(view, b));
    context.stroke();
  };
  const link = element.kind === "link" ? drawing.links.find((one) => one.name === element.name) : undefined;
  if (link) for (const [a, b] of sides(drawing, link.points)) line(a, b);
  if (element.kind === "spring") line(...(drawing.springs[element.index]?.at.map((name) => placeOf(drawing, name)) as [Point, Point]));
  const point = element.kind === "point" ? element.name : element.kind === "joint" ? drawing.joints.find((one) => one.name === element.name)?.at : link?.points.length === 1 ? link.points[0] : undefined;
  const at = point === undefined ? undefined : placeOf(drawing, point);
  if (at) {
    context.lineWidth = 6;
    context.globalAlpha = 0.6;
    ring(context, page(view, at), 14, colour);
  }
  context.restore();
}

function drawRanges(context: CanvasRenderingContext2D, view: View, drawing: Drawing, theme: Theme): void {
  const colour = theme.curves[0] ?? theme.ink;
  context.save();
  context.strokeStyle = colour;
  context.lineWidth = 1.5;
  for (const own of drawing.coordinates) {
    context.setLineDash([4, 3]);
    const angle = own.kind === "angle" ? angleFrame(drawing, own) : undefined;
    if (angle && Number.isFinite(own.low) && Number.isFinite(own.high)) {
      const at = page(view, angle.at);
      context.beginPath();
      const steps = 60;
      for (let k = 0; k <= steps; ++k) {
        const turn = angle.zero + own.low + ((own.high - own.low) * k) / steps;
        const radius = angleRadii[0] + ((angleRadii[1] - angleRadii[0]) * k) / steps;
        context.lineTo(at[0] + radius * Math.cos(turn), at[1] - radius * Math.sin(turn));
      }
      context.stroke();
      words(context, own.name, [at[0] + 58, at[1] - 8], colour, theme);
      context.strokeStyle = colour;
      context.lineWidth = 1.5;
    }
    const stroke = own.kind === "stroke" ? strokeFrame(drawing, own) : undefined;
    const ends = stroke ? [onStroke(stroke, own.low), onStroke(stroke, own.high)] : [];
    const [low, high] = ends;
    if (low && high && [...low, ...high].every(Number.isFinite)) {
      context.beginPath();
      context.moveTo(...page(view, low));
      context.lineTo(...page(view, high));
      context.stroke();
      const end = page(view, high);
      words(context, own.name, [end[0] + 8, end[1] - 8], colour, theme);
      context.strokeStyle = colour;
      context.lineWidth = 1.5;
    }
  }
  const box = boxOf(drawing);
  if (box && [...box.low, ...box.high].every(Number.isFinite)) {
    const [from, to] = [page(view, [box.low[0], box.high[1]]), page(view, [box.high[0], box.low[1]])];
    context.setLineDash([6, 4]);
    context.strokeRect(from[0], from[1], to[0] - from[0], to[1] - from[1]);
    words(context, `place of ${box.point}`, [from[0] + 4, from[1] - 5], colour, theme);
  }
  context.setLineDash([]);
  context.strokeStyle = colour;
  context.fillStyle = theme.paper;
  context.lineWidth = 1.6;
  for (const handle of handlesOf(drawing, 1 / view.scale[0])) {
    const at = page(view, handle.at);
    context.beginPath();
    context.rect(at[0] - 4, at[1] - 4, 8, 8);
    context.fill();
    context.stroke();
  }
  context.restore();
}

export interface Shown {
  selected: Element | undefined;
  /** What a refusal is about. */
  wrong: Element | undefined;
  /** Pixels a newton. */
  arrow: number;
}

export function drawDrawing(context: CanvasRenderingContext2D, view: View, drawing: Drawing, theme: Theme, shown: Shown): void {
  const sketch = sketchOf(drawing);
  context.save();
  if (shown.selected) highlight(context, view, drawing, shown.selected, theme.curves[0] ?? theme.ink);
  if (shown.wrong) highlight(context, view, drawing, shown.wrong, theme.failed);
  drawSketch(context, view, sketch, theme);
  drawBlocks(context, view, drawing, theme);
  drawSlots(context, view, drawing, theme);
  drawTies(context, view, drawing, theme, shown.selected);
  drawSprings(context, view, sketch, theme);
  for (const point of drawing.points) {
    const lone = point.at && carriers(drawing, point.name).length > 0 && !drawing.joints.some((joint) => joint.at === point.name);
    if (!lone || !point.at) continue;
    context.lineWidth = 1.5;
    ring(context, page(view, point.at), 3.5, theme.outline, theme.paper);
  }
  const end = drawing.endEffector && placeOf(drawing, drawing.endEffector.at);
  if (end) {
    const at = page(view, end);
    context.lineWidth = 1.5;
    ring(context, at, 9, theme.load);
  }
  drawRanges(context, view, drawing, theme);
  drawSizes(context, view, drawing, theme, shown.selected);
  drawForces(context, view, drawing, shown.arrow, theme, shown.selected);
  drawNames(context, view, { ...sketch, joints: drawing.points.flatMap((point) => (point.at ? [{ name: point.name, at: point.at, on_ground: isGround(drawing, point.name), actuated: false }] : [])) }, theme);
  context.restore();
}

