import { describe, expect, it } from "vitest";
import { areaWords, lengthWords, placeWords, siUnits, turnWords, unitOf, unitsOf } from "./units";

const millimetres = unitsOf({ length: "mm", angle: undefined, force: "kN" });

describe("SI answers", () => {
  it("are told in the file's units", () => {
    expect(lengthWords(0.25, millimetres)).toBe("250 mm");
    expect(areaWords(0.02, millimetres)).toBe("20000 mm²");
    expect(placeWords([0.25, -0.7], [false, false], millimetres)).toBe("(250, -700) mm");
    expect(placeWords([0.25, Math.PI / 6], [false, true], millimetres)).toBe("(250 mm, 30 deg)");
    expect(millimetres.force).toEqual({ name: "kN", size: 1000 });
  });
  it("have degrees unless the file says otherwise", () => {
    expect(unitOf(millimetres, true).name).toBe("deg");
    expect(unitOf(unitsOf({ angle: "rad" }), true).name).toBe("rad");
    expect(turnWords(1e-3, siUnits)).toBe("1 mrad");
  });
  it("are in what reads best where the file says nothing", () => {
    expect([2.8e-4, 1.2e-5, 0.03, 0.45, 0].map((value) => lengthWords(value, siUnits))).toEqual(["280 µm", "12 µm", "30 mm", "0.45 m", "0 m"]);
    expect(lengthWords(null, siUnits)).toBe("unbounded");
  });
});
