// What lies under the pointer, and what a motion crosses.
import type { Curve, Point, Zone } from "../data/answers";
import type { Shown } from "./loci";
import { page, type View } from "./view";

export function distanceToSegment(p: Point, a: Point, b: Point): number {
  const ux = b[0] - a[0];
  const uy = b[1] - a[1];
  const length = ux * ux + uy * uy;
  const t = length === 0 ? 0 : Math.min(1, Math.max(0, ((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / length));
  return Math.hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy);
}

/** The curve nearest to a place of the canvas, within `reach` pixels; of equals the gravest kind. */
export function curveAt(shown: Shown, view: View, at: Point, reach = 7): Curve | undefined {
  let best: Curve | undefined;
  let nearest = reach;
  for (const { curve } of shown.curves) {
    for (const arc of curve.arcs) {
      let before: Point | undefined;
      for (const point of arc.points) {
        const now = page(view, point);
        if (before) {
          const away = distanceToSegment(at, before, now);
          if (away < nearest - 1e-6) [nearest, best] = [away, curve];
        }
        before = now;
      }
    }
  }
  return best;
}

export function inRings(rings: readonly Point[][], at: Point): boolean {
  let inside = false;
  for (const ring of rings) {
    for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
      const a = ring[i];
      const b = ring[j];
      if (!a || !b) continue;
      if (a[1] > at[1] !== b[1] > at[1] && at[0] < ((b[0] - a[0]) * (at[1] - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
    }
  }
  return inside;
}

export function zoneAt(zones: readonly Zone[], at: Point): Zone | undefined {
  return zones.find((zone) => inRings(zone.polygon, at));
}

function side(a: Point, b: Point, p: Point): number {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/** The curves that the way from one pose to the next crosses, each once. */
export function crossed(shown: Shown, from: Point, to: Point): Curve[] {
  const low: Point = [Math.min(from[0], to[0]), Math.min(from[1], to[1])];
  const high: Point = [Math.max(from[0], to[0]), Math.max(from[1], to[1])];
  const hit = (a: Point, b: Point): boolean => {
    if (Math.max(a[0], b[0]) < low[0] || Math.min(a[0], b[0]) > high[0]) return false;
    if (Math.max(a[1], b[1]) < low[1] || Math.min(a[1], b[1]) > high[1]) return false;
    return side(from, to, a) > 0 !== side(from, to, b) > 0 && side(a, b, from) > 0 !== side(a, b, to) > 0;
  };
  return shown.curves.flatMap(({ curve }) =>
    curve.arcs.some((arc) => arc.points.some((point, k) => k > 0 && hit(arc.points[k - 1] ?? point, point))) ? [curve] : [],
  );
}
