import { describe, expect, it } from "vitest";
import { evaluate } from "./expression";

describe("expressions", () => {
  const symbols = (name: string): number | undefined => ({ L: 3, mm: 0.001, deg: Math.PI / 180 })[name];
  it.each([["1/2", 0.5], ["-2^2", -4], ["2*(L - 1)", 4], ["12 mm", 0.012], ["L*cos(60 deg)", 1.5], ["1e-3 + .5", 0.501], ["2^-1", 0.5], ["3 - 2 - 1", 0]])("%s is %d", (text, value) => {
    expect(evaluate(text, symbols)).toBeCloseTo(value, 12);
  });
  it.each(["x", "", "(1", "1)", "cos 3", "1 2", "* 3", "0,5"])("%s is no number", (text) => {
    expect(evaluate(text, symbols)).toBeNaN();
  });
});
