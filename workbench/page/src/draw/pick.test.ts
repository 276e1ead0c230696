import { describe, expect, it } from "vitest";
import type { Curve, CurveGroup, Point } from "../data/answers";
import type { Shown } from "./loci";
import { crossed, curveAt, distanceToSegment, inRings } from "./pick";
import { fit, page, plane, ticks, zoomed } from "./view";

const curve = (id: string, points: Point[]): { curve: Curve; group: CurveGroup } => ({
  curve: { id, arcs: [{ closed: false, length: 1, points }] } as unknown as Curve,
  group: {} as CurveGroup,
});
const shown: Shown = { curves: [curve("c1", [[0, 0], [1, 0]]), curve("c2", [[0, 1], [1, 1]])], points: [], rings: [] };
const view = fit({ low: [0, 0], high: [1, 1] }, { width: 200, height: 200 }, true, 50);

describe("places", () => {
  it("go to the canvas and back", () => {
    for (const at of [[0, 0], [1, 0.25], [-3, 7]] as Point[]) {
      const back = plane(view, page(view, at));
      expect(back[0]).toBeCloseTo(at[0], 12);
      expect(back[1]).toBeCloseTo(at[1], 12);
    }
  });
  it("stay under the pointer while one zooms", () => {
    const nearer = zoomed(view, [70, 90], 3);
    const before = plane(view, [70, 90]);
    const after = plane(nearer, [70, 90]);
    expect(after[0]).toBeCloseTo(before[0], 12);
    expect(after[1]).toBeCloseTo(before[1], 12);
  });
  it("have round ticks, angles in degrees", () => {
    expect(ticks(-1, 1, 100, 45, { name: "m", size: 1 })).toEqual([-1, -0.5, 0, 0.5, 1]);
    expect(ticks(0, 2 * Math.PI, 60, 80, { name: "deg", size: Math.PI / 180 }).map((one) => Math.round((one * 180) / Math.PI))).toEqual([0, 90, 180, 270, 360]);
    const inch = { name: "in", size: 0.0254 };
    expect(ticks(0, 0.127, 1000, 45, inch).map((one) => one / inch.size)).toEqual([0, 2, 4]);
  });
});

describe("picking", () => {
  it("finds the nearest curve within reach", () => {
    expect(curveAt(shown, view, page(view, [0.5, 0.03]))?.id).toBe("c1");
    expect(curveAt(shown, view, page(view, [0.5, 0.97]))?.id).toBe("c2");
    expect(curveAt(shown, view, page(view, [0.5, 0.5]))).toBeUndefined();
  });
  it("measures to the ends of a segment", () => {
    expect(distanceToSegment([3, 4], [0, 0], [0, 0])).toBe(5);
    expect(distanceToSegment([2, 1], [0, 0], [1, 0])).toBeCloseTo(Math.SQRT2);
  });
  it("knows what a way crosses", () => {
    expect(crossed(shown, [0.5, -0.5], [0.5, 0.5]).map((one) => one.id)).toEqual(["c1"]);
    expect(crossed(shown, [0.5, -0.5], [0.6, 1.5]).map((one) => one.id)).toEqual(["c1", "c2"]);
    expect(crossed(shown, [1.5, -0.5], [1.5, 1.5])).toEqual([]);
  });
  it("takes holes for outside", () => {
    const square = (r: number): Point[] => [[-r, -r], [r, -r], [r, r], [-r, r], [-r, -r]];
    expect(inRings([square(2), square(1)], [1.5, 0])).toBe(true);
    expect(inRings([square(2), square(1)], [0, 0])).toBe(false);
    expect(inRings([square(2), square(1)], [3, 0])).toBe(false);
  });
});
