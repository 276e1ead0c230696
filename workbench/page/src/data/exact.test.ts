import { describe, expect, it } from "vitest";
import { parseExact, roundText, shortNumber, toLatex, toNumber, toText } from "./exact";

describe("exact numbers", () => {
  it.each([
    ["7/20", "7/20"], ["0.35", "7/20"], [" -3 ", "-3"], ["10e-6", "1/100000"], ["1e3", "1000"], [".5", "1/2"], ["2.", "2"], ["-4/6", "-2/3"], ["+1", "1"],
  ])("reads %s as %s", (text, exact) => {
    const value = parseExact(text);
    expect(value && toText(value)).toBe(exact);
  });
  it.each(["2*L", "30 deg", "", ".", "1/0", "1.2.3", "1e", "L", "0,5", "1/2/3", "--1"])("takes %s for no number", (text) => {
    expect(parseExact(text)).toBeUndefined();
  });
  it("gives the nearest double", () => {
    for (const text of ["0.1", "7/20", "-1e-30", "123456789.123"]) {
      const value = parseExact(text);
      const [top, below] = text.includes("/") ? text.split("/").map(Number) : [Number(text), 1];
      expect(value && toNumber(value)).toBeCloseTo((top ?? 0) / (below ?? 1), 12);
    }
  });
});

describe("values the hand reaches", () => {
  it.each([
    [0.34567, 0.0025, "0.346"], [0.34567, 0.01, "0.35"], [-12.4, 1, "-12"], [1.2345e-5, 5e-8, "12.34e-6"], [0, 0.01, "0"], [250.7, 10, "250"],
  ])("writes %d by steps of %d as %s", (value, step, text) => {
    expect(roundText(value, step)).toBe(text);
  });
  it("writes what reads back within a step", () => {
    for (const value of [0.123456, 3.5e-5, -0.00071, 812.345, 1e-7])
      for (const step of [1e-8, 1e-6, 1e-3]) {
        const read = parseExact(roundText(value, step));
        expect(Math.abs((read ? toNumber(read) : NaN) - value)).toBeLessThanOrEqual(step);
      }
  });
});

describe("words", () => {
  it("shortens numbers", () => {
    expect([1234.567, 0, 1e-9, -0.1].map((value) => shortNumber(value))).toEqual(["1235", "0", "1e-9", "-0.1"]);
  });
  it("turns polynomials into LaTeX", () => {
    expect(toLatex("x^2 + y^12 - 1/2*x*y + 3/4")).toBe("x^{2} + y^{12} - \\frac{1}{2} x y + \\frac{3}{4}");
    expect(toLatex("xB1^2*cos(theta)")).toBe("xB_{1}^{2} \\cos(theta)");
  });
});
