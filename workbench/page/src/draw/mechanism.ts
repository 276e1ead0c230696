// The mechanism on a canvas, as the pictures draw it, and what its joints bear.
import type { ModelFacts, Point, Pose, Sketch, Theme } from "../data/answers";
import { page, type Box, type View } from "./view";

const bar = 9;

function strokeBar(context: CanvasRenderingContext2D, points: Point[], width: number, theme: Theme): void {
  const path = (): void => {
    context.beginPath();
    points.forEach(([x, y], k) => (k === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
  };
  context.lineCap = "round";
  context.lineJoin = "round";
  context.setLineDash([]);
  path();
  context.globalAlpha = 0.6;
  context.lineWidth = width;
  context.strokeStyle = theme.outline;
  context.stroke();
  context.globalAlpha = 0.9;
  context.lineWidth = width - 2;
  context.strokeStyle = theme.link;
  context.stroke();
  context.globalAlpha = 1;
}

function disc(context: CanvasRenderingContext2D, at: Point, radius: number, colour: string): void {
  context.beginPath();
  context.arc(at[0], at[1], radius, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
}

function drawGround(context: CanvasRenderingContext2D, at: Point, theme: Theme): void {
  const half = 9;
  const height = 13;
  context.lineWidth = 1;
  context.strokeStyle = theme.outline;
  context.fillStyle = theme.paper;
  context.beginPath();
  context.moveTo(at[0], at[1]);
  context.lineTo(at[0] - 0.75 * half, at[1] + height);
  context.lineTo(at[0] + 0.75 * half, at[1] + height);
  context.closePath();
  context.fill();
  context.stroke();
  context.beginPath();
  context.moveTo(at[0] - 1.25 * half, at[1] + height);
  context.lineTo(at[0] + 1.25 * half, at[1] + height);
  for (let x = -1.25 * half + 4.5; x <= 1.25 * half + 0.01; x += 4.5) {
    context.moveTo(at[0] + x, at[1] + height);
    context.lineTo(at[0] + x - 4.5, at[1] + height + 4.5);
  }
  context.stroke();
}

/** All places that the sketch of a mechanism holds. */
export function placesOf(sketch: Sketch): Point[] {
  return [
    ...sketch.joints.map((joint) => joint.at),
    ...sketch.links.flatMap((link) => link.points),
    ...sketch.slides.flatMap((slide) => [slide.from, slide.to]),
    ...(sketch.springs ?? []).flatMap((spring) => (spring.torsion ? [spring.from] : [spring.from, spring.to])),
  ];
}

/** A mechanism in space, seen from the front right and a little above. */
export function projected(pose: Pose, facts: ModelFacts | undefined): Sketch {
  const place = (name: string): Point => {
    const [x = 0, y = 0, z = 0] = pose.posture[name] ?? [];
    return [0.87 * x + 0.5 * y, 0.94 * z + 0.17 * (0.87 * y - 0.5 * x)];
  };
  const first = (link: string): string | undefined => facts?.links.find((one) => one.name === link)?.points[0];
  return {
    links: (facts?.links ?? []).map((link) => ({ name: link.name, points: link.points.map(place) })),
    slides: (facts?.joints ?? []).filter((joint) => joint.type === "prismatic").flatMap((joint) => {
      const [from, to] = [first(joint.from), first(joint.to)];
      return from && to ? [{ from: place(from), to: place(to), rail: false }] : [];
    }),
    joints: (facts?.joints ?? []).map((joint) => ({ name: joint.name, at: place(joint.at), on_ground: joint.from === "ground", actuated: joint.actuated })),
    loads: [],
    gravity: [0, 0],
  };
}

/** The least box around all that a sketch holds; nothing where it holds nothing. */
export function boxAround(places: readonly Point[]): Box | undefined {
  if (places.length === 0) return undefined;
  const xs = places.map((at) => at[0]);
  const ys = places.map((at) => at[1]);
  return { low: [Math.min(...xs), Math.min(...ys)], high: [Math.max(...xs), Math.max(...ys)] };
}

export function drawSketch(context: CanvasRenderingContext2D, view: View, sketch: Sketch, theme: Theme, width = bar): void {
  const small = width < bar;
  context.save();
  if (!small) for (const joint of sketch.joints) if (joint.on_ground) drawGround(context, page(view, joint.at), theme);
  for (const slide of sketch.slides) {
    const from = page(view, slide.from);
    const to = page(view, slide.to);
    if (slide.rail) {
      context.globalAlpha = 0.5;
      context.lineWidth = small ? 1.5 : 3;
      context.strokeStyle = theme.outline;
      context.beginPath();
      context.moveTo(...from);
      context.lineTo(...to);
      context.stroke();
      context.globalAlpha = 1;
      continue;
    }
    const middle: Point = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
    strokeBar(context, [middle, to], 0.55 * width, theme);
    strokeBar(context, [from, middle], width, theme);
  }
  for (const link of sketch.links) {
    const points = link.points.map((point) => page(view, point));
    if (points.length > 2 && points[0]) points.push(points[0]);
    if (points.length > 1) strokeBar(context, points, width, theme);
  }
  for (const joint of sketch.joints) {
    const at = page(view, joint.at);
    const radius = small ? 2 : 3.8;
    if (joint.actuated && !small) {
      disc(context, at, radius + 2.8, theme.outline);
      disc(context, at, radius + 1.6, theme.paper);
      disc(context, at, radius, theme.outline);
    } else {
      disc(context, at, radius, theme.outline);
      if (!joint.actuated) disc(context, at, radius - (small ? 0.9 : 1.3), theme.paper);
    }
  }
  context.restore();
}

/** A zigzag from end to end; of a torsion spring a coil around its joint. */
export function drawSprings(context: CanvasRenderingContext2D, view: View, sketch: Sketch, theme: Theme): void {
  context.save();
  context.lineJoin = "round";
  for (const spring of sketch.springs ?? []) {
    const from = page(view, spring.from);
    const to = page(view, spring.to);
    if (spring.from_ground) drawGround(context, from, theme);
    if (spring.to_ground) drawGround(context, to, theme);
    context.strokeStyle = theme.load;
    context.lineWidth = 1.4;
    context.beginPath();
    if (spring.torsion) {
      for (let k = 0; k <= 48; ++k) {
        const turn = (3 * Math.PI * k) / 48;
        const radius = 7 + (5 * k) / 48;
        context.lineTo(from[0] + radius * Math.cos(turn), from[1] - radius * Math.sin(turn));
      }
    } else {
      const length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1;
      const across: Point = [(-5 * (to[1] - from[1])) / length, (5 * (to[0] - from[0])) / length];
      context.moveTo(...from);
      for (let k = 0; k < 12; ++k) {
        const t = 0.15 + (0.7 * (k + 0.5)) / 12;
        const sign = k % 2 === 0 ? 1 : -1;
        context.lineTo(from[0] + t * (to[0] - from[0]) + sign * across[0], from[1] + t * (to[1] - from[1]) + sign * across[1]);
      }
      context.lineTo(...to);
    }
    context.stroke();
  }
  context.restore();
}

/** Joints that stand at one place of the canvas share a label. */
export function namedPlaces(joints: { name: string; at: Point; on_ground: boolean }[]): { at: Point; names: string[]; raised: boolean }[] {
  const near = 6; // pixels
  const places: { at: Point; names: string[]; raised: boolean }[] = [];
  for (const joint of joints) {
    const place = places.find((one) => Math.hypot(one.at[0] - joint.at[0], one.at[1] - joint.at[1]) < near);
    if (place) {
      place.names.push(joint.name);
      place.raised ||= joint.on_ground;
    } else places.push({ at: joint.at, names: [joint.name], raised: joint.on_ground });
  }
  return places;
}

export function drawNames(context: CanvasRenderingContext2D, view: View, sketch: Sketch, theme: Theme): void {
  context.save();
  context.font = "600 12px system-ui, sans-serif";
  context.lineJoin = "round";
  context.lineWidth = 3;
  context.strokeStyle = theme.paper;
  context.fillStyle = theme.ink;
  for (const { at, names, raised } of namedPlaces(sketch.joints.map((joint) => ({ ...joint, at: page(view, joint.at) })))) {
    const below = raised ? -10 : 16;
    context.strokeText(names.join(", "), at[0] + 8, at[1] + below);
    context.fillText(names.join(", "), at[0] + 8, at[1] + below);
  }
  const end = sketch.end_effector;
  if (end && !sketch.joints.some((joint) => joint.at[0] === end.at[0] && joint.at[1] === end.at[1])) {
    const at = page(view, end.at);
    context.strokeText(end.name, at[0] + 8, at[1] - 8);
    context.fillText(end.name, at[0] + 8, at[1] - 8);
  }
  context.restore();
}

export function drawArrow(context: CanvasRenderingContext2D, tail: Point, tip: Point, colour: string, width = 2): void {
  const length = Math.hypot(tip[0] - tail[0], tip[1] - tail[1]);
  if (length < 1) return;
  const head = Math.min(9, length);
  const ux = (tip[0] - tail[0]) / length;
  const uy = (tip[1] - tail[1]) / length;
  context.strokeStyle = colour;
  context.fillStyle = colour;
  context.lineWidth = width;
  context.lineCap = "butt";
  context.setLineDash([]);
  context.beginPath();
  context.moveTo(...tail);
  context.lineTo(tip[0] - head * ux, tip[1] - head * uy);
  context.stroke();
  context.beginPath();
  context.moveTo(...tip);
  context.lineTo(tip[0] - head * ux - 0.4 * head * uy, tip[1] - head * uy + 0.4 * head * ux);
  context.lineTo(tip[0] - head * ux + 0.4 * head * uy, tip[1] - head * uy - 0.4 * head * ux);
  context.closePath();
  context.fill();
}

/** Arrows of loads and reactions grow with the root of their size, so that small ones still show. */
function arrowLength(size: number, largest: number, longest: number): number {
  return largest > 0 ? longest * Math.sqrt(Math.min(1, size / largest)) : 0;
}

export function drawLoads(context: CanvasRenderingContext2D, view: View, sketch: Sketch, theme: Theme): void {
  const largest = Math.max(0, ...sketch.loads.map((load) => Math.hypot(...load.force)));
  context.save();
  for (const load of sketch.loads) {
    const size = Math.hypot(...load.force);
    if (size === 0) continue;
    const at = page(view, load.at);
    const length = arrowLength(size, largest, 52);
    const tip: Point = [at[0] + (load.force[0] / size) * (length + 6), at[1] - (load.force[1] / size) * (length + 6)];
    drawArrow(context, [at[0] + (load.force[0] / size) * 6, at[1] - (load.force[1] / size) * 6], tip, theme.load, 2.4);
    context.font = "600 11px system-ui, sans-serif";
    context.fillStyle = theme.load;
    context.fillText(`${Number(size.toPrecision(4))} N`, tip[0] + 6, tip[1] + 4);
  }
  context.restore();
}

export interface ReactionArrow {
  joint: string;
  force: Point;
  couple: number | undefined;
  lost: boolean;
}

/** What each joint's `from` exerts on its `to`, of a planar pose. */
export function reactionArrows(pose: Pose): ReactionArrow[] {
  const lost = new Set(pose.vanishing.map((one) => one.joint));
  return Object.entries(pose.reactions).map(([joint, parts]) => ({
    joint,
    force: [parts["fx"] ?? 0, parts["fy"] ?? 0],
    couple: parts["M"] ?? undefined,
    lost: lost.has(joint),
  }));
}

export function drawReactions(context: CanvasRenderingContext2D, view: View, sketch: Sketch, arrows: ReactionArrow[], theme: Theme): void {
  const finite = arrows.filter((one) => one.force.every(Number.isFinite));
  const largest = Math.max(0, ...finite.map((one) => Math.hypot(...one.force)));
  const colour = theme.curves[0] ?? theme.ink;
  context.save();
  for (const one of finite) {
    const joint = sketch.joints.find((own) => own.name === one.joint);
    const size = Math.hypot(...one.force);
    if (!joint || size === 0 || size < 1e-9 * largest) continue;
    const at = page(view, joint.at);
    const length = arrowLength(size, largest, 58);
    drawArrow(context, at, [at[0] + (one.force[0] / size) * length, at[1] - (one.force[1] / size) * length], colour, 1.8);
  }
  context.restore();
}

/** Where the pin stands in its hub: the clearance as a ring, magnified. */
export function drawTakeUp(context: CanvasRenderingContext2D, view: View, sketch: Sketch, pose: Pose, factor: number, theme: Theme): void {
  context.save();
  for (const joint of sketch.joints) {
    const own = pose.take_up[joint.name];
    if (!own || own.dx === undefined) continue;
    const at = page(view, joint.at);
    const lost = own.dx === null || own.dy === null || own.dy === undefined;
    const dx = own.dx ?? 0;
    const dy = own.dy ?? 0;
    const radius = lost ? 10 : Math.hypot(dx, dy) * factor * view.scale[0];
    context.lineWidth = 1.4;
    context.strokeStyle = lost ? theme.failed : theme.curves[1] ?? theme.ink;
    context.setLineDash(lost ? [3, 3] : []);
    context.beginPath();
    context.arc(at[0], at[1], Math.max(radius, 4), 0, 2 * Math.PI);
    context.stroke();
    if (!lost) disc(context, [at[0] + dx * factor * view.scale[0], at[1] - dy * factor * view.scale[1]], 2.6, theme.curves[1] ?? theme.ink);
  }
  context.restore();
}
