// Poses along a way: a task's path, the cycle of a linkage.

export interface Way {
  /** Distance in m, or the coordinate itself. */
  x: number[];
  /** Pose after pose. */
  poses: number[];
  label: string;
}

/** Even steps along a polyline. */
export function alongPath(points: readonly (readonly [number, number])[], steps: number): Way {
  const lengths = points.slice(1).map((point, k) => Math.hypot(point[0] - (points[k]?.[0] ?? 0), point[1] - (points[k]?.[1] ?? 0)));
  const total = lengths.reduce((sum, one) => sum + one, 0);
  const way: Way = { x: [], poses: [], label: "distance (m)" };
  for (let i = 0; i <= steps; ++i) {
    let left = (total * i) / steps;
    let k = 0;
    while (k + 1 < lengths.length && left > (lengths[k] ?? 0)) left -= lengths[k++] ?? 0;
    const [from, to] = [points[k], points[k + 1]];
    if (!from || !to) break;
    const t = Math.min(1, left / (lengths[k] || 1));
    way.x.push((total * i) / steps);
    way.poses.push(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]));
  }
  return way;
}

export function alongCycle(lower: number, upper: number, steps: number): number[] {
  return Array.from({ length: steps + 1 }, (_, k) => lower + ((upper - lower) * k) / steps);
}

/** Where values change their sign, or end at a gap beside which they vanish, between samples. */
export function signChanges(x: readonly number[], values: readonly (number | null)[]): number[] {
  const found: number[] = [];
  for (let k = 1; k < x.length; ++k) {
    const [a, b] = [values[k - 1], values[k]];
    if (a === null || b === null || a === undefined || b === undefined) continue;
    if (a === 0 ? b !== 0 && k === 1 : a * b < 0) found.push((x[k - 1] ?? 0) + (((x[k] ?? 0) - (x[k - 1] ?? 0)) * Math.abs(a)) / (Math.abs(a) + Math.abs(b) || 1));
    if (b === 0) found.push(x[k] ?? 0);
  }
  return found;
}

/** Of values along a way the one whose place is nearest. */
export function nearestOnWay(values: readonly number[], places: readonly (readonly number[] | null)[], to: readonly [number, number]): number | undefined {
  let best = -1;
  let nearest = Infinity;
  places.forEach((place, k) => {
    const away = place ? Math.hypot((place[0] ?? 0) - to[0], (place[1] ?? 0) - to[1]) : Infinity;
    if (away < nearest) [nearest, best] = [away, k];
  });
  return values[best];
}
