// A hand pulls at any moving point: the free coordinates follow, by the point's slopes over them (damped least squares, of
// differences that the program answers).
import type { Point, Sweep } from "../data/answers";
import { ask, AskingError } from "./asking";
import type { Workbench } from "./workbench";

/**
 * The step of the coordinates that brings a point from `at` towards `to`: (JᵀJ + λ) s = Jᵀ (to − at), with a column of J a
 * coordinate, in units of its range. λ, beside the largest slope, holds still what hardly moves the point.
 */
export function stepTowards(at: Point, to: Point, slopes: readonly Point[]): number[] {
  const damping = 1e-4 * Math.max(...slopes.map((one) => one[0] ** 2 + one[1] ** 2));
  if (damping === 0) return slopes.map(() => 0);
  const off: Point = [to[0] - at[0], to[1] - at[1]];
  // The same in the plane: s = Jᵀ (J Jᵀ + λ)⁻¹ (to − at).
  const sum = (f: (one: Point) => number): number => slopes.reduce((total, one) => total + f(one), 0);
  const [xx, xy, yy] = [sum((one) => one[0] ** 2) + damping, sum((one) => one[0] * one[1]), sum((one) => one[1] ** 2) + damping];
  const determinant = xx * yy - xy * xy;
  const pulled: Point = [(yy * off[0] - xy * off[1]) / determinant, (xx * off[1] - xy * off[0]) / determinant];
  return slopes.map((one) => one[0] * pulled[0] + one[1] * pulled[1]);
}

const difference = 1e-5; // of a coordinate's range
const farthest = 0.08; // of its range a step

export class Pull {
  private target: Point | undefined;
  private running = false;

  constructor(private readonly bench: Workbench) {}

  /** Towards a place, as long as it is new; the last one wins. */
  towards(name: string, to: Point): void {
    this.target = to;
    if (!this.running) void this.run(name);
  }

  stop(): void {
    this.target = undefined;
  }

  private async run(name: string): Promise<void> {
    this.running = true;
    const { bench } = this;
    try {
      for (let steps = 0; this.target && steps < 6; ++steps) {
        const to = this.target;
        const { at } = bench.state;
        if (!at || at.length !== bench.coordinates.length) return;
        const spans = bench.coordinates.map((one) => one.upper - one.lower);
        const poses = [at, ...spans.map((span, k) => at.map((value, i) => (i === k ? value + difference * span : value)))];
        const answer = await ask<Sweep>("sweep", { text: bench.state.text, file: bench.state.file, mode: bench.state.mode ?? [], poses: poses.flat(), follow: name, lane: "pull" });
        const [here, ...beside] = answer.places.map((place): Point | undefined => (place ? [place[0] ?? 0, place[1] ?? 0] : undefined));
        if (!here || beside.some((one) => one === undefined)) return;
        const slopes = beside.map((one): Point => [((one?.[0] ?? 0) - here[0]) / difference, ((one?.[1] ?? 0) - here[1]) / difference]);
        const step = stepTowards(here, to, slopes).map((part) => Math.max(-farthest, Math.min(farthest, part)));
        bench.change({ at: at.map((value, k) => within(value + (step[k] ?? 0) * (spans[k] ?? 0), bench.coordinates[k])) }, "drag-pose");
        if (this.target !== to) steps = 0;
        else if (step.every((part) => Math.abs(part) < 1e-4)) return;
      }
    } catch (error) {
      if (!(error instanceof AskingError)) throw error;
    } finally {
      this.running = false;
    }
  }
}

function within(value: number, range: { lower: number; upper: number } | undefined): number {
  return range ? Number(Math.max(range.lower, Math.min(range.upper, value)).toPrecision(10)) : value;
}
