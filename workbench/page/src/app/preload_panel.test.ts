import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { FeasibleEfforts } from "../data/answers";
import { ModelText, usualEffort } from "../data/model_text";
import { effortSpan, feasibleParts } from "./preload_panel";

const text = readFileSync(new URL("../../../../examples/studies/antagonistic.yaml", import.meta.url), "utf8");
const own = (changed: string): ReturnType<ModelText["freeEfforts"]["at"]> => new ModelText(changed).freeEfforts[0];
const gap = { joint: "A1", quantity: "M" };
const feasible: FeasibleEfforts = { effort: 0, within: null, ranges: [{ from: null, to: -6, below: [], above: [gap] }, { from: 15, to: null, below: [gap], above: [] }], never: [] };

describe("free efforts", () => {
  it("are found in the file, with what the motor can exert", () => {
    expect(own(text)).toEqual({ joint: "B2", unit: "N m", within: undefined });
    const bounded = own(text.replace("effort: free", "effort: free, within: [2, 30]"));
    expect(bounded?.within).toEqual([2, 30]);
    expect(bounded && usualEffort(bounded)).toBe("2");
    expect(new ModelText(text.replace("effort: free", "effort: -20")).freeEfforts).toEqual([]);
  });
  it("cover what ends their ranges", () => {
    const free = { joint: "B2", unit: "N m", within: undefined };
    const [low, high] = effortSpan(free, 0, feasible, 1);
    expect(high).toBeGreaterThan(15);
    expect(low).toBe(-high);
    expect(effortSpan({ ...free, within: [-5, 5] }, 0, feasible, 1)).toEqual([-5, 5]);
  });
  it("are drawn from end to end of each range", () => {
    const parts = feasibleParts(feasible, [-30, 30], 1);
    expect(parts.map(({ from, to }) => [from, to])).toEqual([[0, 0.4], [0.75, 1]]);
    expect(parts[0]?.words).toContain("to -6 (M_A1)");
    expect(feasibleParts(feasible, [-5, 5], 1)).toEqual([]); // the motor can exert none of them
  });
});
