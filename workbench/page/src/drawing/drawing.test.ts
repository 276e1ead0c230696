import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { Point } from "../data/answers";
import { parseFile, slotOf } from "../data/file_text";
import { ModelText } from "../data/model_text";
import { setRangeEnd } from "./coordinates";
import { drawingOf, drawnPose, placeOf, type Drawing, type DrawnCoordinate } from "./drawing";
import { movePoint, newFile } from "./edit";
import { elementOf, isThere, pathOf, type Element } from "./element";
import { fieldsOf, switchesOf } from "./fields";
import { angleText, arrowScale, elementAt, gripAt, handlesOf } from "./grips";
import { missingIn } from "./missing";
import { removeElement } from "./remove";
import { rename, renameFault } from "./rename";
import { linksAt, snap } from "./snap";
import { tools } from "./tools/list";
import { moveGrip } from "./tools/select";
import type { Hand } from "./tools/tool";

const examples = new URL("../../../../examples/", import.meta.url);
const pixel = 1e-3; // a pixel is a mm

/** A hand on a sheet in mm. */
class Sheet {
  drawing: Drawing = drawingOf(newFile("mm"));
  private hand(from: Point, to: Point): Hand {
    const { drawing } = this;
    const [a, b] = [from, to].map((at): Point => [at[0] / 1000, at[1] / 1000]) as [Point, Point];
    return {
      drawing, from: snap(drawing, a, pixel, { grid: true, lengths: false }), to: snap(drawing, b, pixel, { grid: true, lengths: false }, a),
      element: elementAt(drawing, a, pixel), under: linksAt(drawing, a, pixel), over: linksAt(drawing, b, pixel), pixel, arrow: 1 / arrowScale(drawing),
    };
  }
  use(id: string, from: Point, to = from): this {
    const text = tools.find((one) => one.id === id)?.act(this.hand(from, to));
    if (text !== undefined) this.drawing = drawingOf(text);
    return this;
  }
  grip(from: Point, to: Point): this {
    const grip = gripAt(this.drawing, [from[0] / 1000, from[1] / 1000], pixel);
    const text = grip && moveGrip(grip, this.hand(from, to));
    if (text !== undefined) this.drawing = drawingOf(text);
    return this;
  }
  get lines(): string[] {
    return this.drawing.text.split("\n");
  }
}

const fiveBar = (): Sheet =>
  new Sheet().use("ground", [0, 0]).use("ground", [500, 0]).use("link", [0, 0], [-200, 300]).use("link", [-200, 300], [250, 600]).use("link", [250, 600], [700, 300]).use("link", [700, 300], [500, 0]);

describe("a drawing", () => {
  it("of a five-bar is its file", () => {
    const sheet = fiveBar().use("motor", [0, 0]).use("motor", [500, 0]).use("force", [250, 600], [250, 500]).use("workspace", [100, 400], [400, 700]);
    expect(sheet.drawing.text).toBe(`format: 1
name: New mechanism
units: {length: mm}
workspace:
  x: {place: x, of: D, within: [100, 400]}
  y: {place: y, of: D, within: [400, 700]}
drawn:
  A: [0, 0]
  B: [500, 0]
  C: [-200, 300]
  D: [250, 600]
  E: [700, 300]
links:
  AC: {points: [A, C]}
  CD: {points: [C, D]}
  DE: {points: [D, E]}
  BE: {points: [B, E]}
joints:
  A: {revolute: [ground, AC], at: A, actuated: true}
  C: {revolute: [AC, CD], at: C}
  D: {revolute: [CD, DE], at: D}
  E: {revolute: [DE, BE], at: E}
  B: {revolute: [ground, BE], at: B, actuated: true}
end_effector: {link: DE, at: D}
loads:
  - {link: DE, at: D, force: [0, -100]}
`);
    expect(drawnPose(sheet.drawing)).toEqual([0.25, 0.6]);
    expect(missingIn(sheet.drawing)).toBeUndefined();
  });
  it("says what it lacks, step by step, at the element", () => {
    const sheet = new Sheet();
    const said = (): string => missingIn(sheet.drawing)?.words ?? "";
    expect(said()).toContain("ground pin");
    sheet.use("ground", [0, 0]);
    expect(missingIn(sheet.drawing)).toEqual({ words: "Draw a link from A", element: { kind: "point", name: "A" } });
    sheet.use("link", [0, 0], [100, 0]);
    expect(missingIn(sheet.drawing)).toMatchObject({ element: { kind: "joint", name: "A" } });
    sheet.use("motor", [0, 0]);
    expect(said()).toContain("force");
    sheet.use("force", [100, 0], [100, -50]);
    expect(said()).toBe("");
    expect(missingIn(new Sheet().use("link", [0, 0], [100, 0]).drawing)?.words).toBe("Link AB has no joint: begin or end a link at one of its points");
  });
  it("of a slider-crank, a quick-return lever and two cylinders", () => {
    const crank = new Sheet().use("ground", [0, 0]).use("link", [0, 0], [90, 120]).use("link", [90, 120], [370, 0]).use("slider", [370, 0], [470, 0]);
    expect(crank.lines).toEqual(expect.arrayContaining(["  block: {points: [C]}", "  C: {revolute: [BC, block], at: C}", "  SC: {prismatic: [ground, block], at: C, axis: [1, 0]}"]));
    const lever = new Sheet().use("ground", [0, 0]).use("link", [0, 0], [30, 40]).use("ground", [0, -100]).use("link", [0, -100], [-60, 160]).use("slider", [30, 40], [-44, 90]);
    expect(lever.lines).toContain("  SB: {prismatic: [CD, block], at: B, axis: [C, D]}");
    const yoke = new Sheet().use("ground", [0, 0]).use("link", [0, 0], [60, 80]).use("link", [60, 200], [60, -60]).use("slider", [60, 80], [60, 150]).use("slider", [60, -20], [160, -20]);
    expect(yoke.lines).toEqual(expect.arrayContaining(["  SB: {prismatic: [CD, block], at: B, axis: [C, D]}", "  SE: {prismatic: [ground, CD], at: E, axis: [1, 0]}", "  CD: {points: [C, D, E]}"]));
    const legs = new Sheet().use("ground", [0, 0]).use("ground", [800, 0]).use("cylinder", [0, 0], [300, 400]).use("cylinder", [800, 0], [300, 400]);
    expect(legs.lines).toEqual(expect.arrayContaining(["  C: {revolute: [rod, rod_2], at: C}", "  SBC: {prismatic: [cylinder_2, rod_2], at: C, axis: [B, C], actuated: true}", "  SAC: {stroke: [250, 750], of: SAC}"]));
    expect(legs.drawing.coordinates.map((one) => one.name)).toEqual(["SAC", "SBC"]);
    expect(drawnPose(legs.drawing)?.[0]).toBeCloseTo(0.5, 12);
  });
  it("has plates, pins on links, springs, masses and free coordinates", () => {
    const sheet = fiveBar().use("plate", [25, 450], [100, 650]).use("pin", [600, 150]).use("spring", [-200, 300], [700, 300]).use("mass", [25, 450]).use("free", [25, 450]);
    expect(sheet.lines).toEqual(expect.arrayContaining(["  CD: {points: [C, D, F], mass: 1}", "gravity: [0, -9.81]", "  - {links: [AC, DE], at: [C, E], stiffness: 1000 N/m, free_length: 0}", "  theta: {angle: [0 deg, 360 deg], of: CD}"]));
    expect(sheet.drawing.links.find((one) => one.name === "BE")?.points).toEqual(["B", "E", "G"]);
    sheet.use("link", [600, 150], [600, 400]);
    expect(sheet.lines).toContain("  G: {revolute: [BE, GH], at: G}");
    sheet.use("free", [25, 450]).use("free", [250, 600]);
    expect(sheet.drawing.coordinates.map((one) => [one.name, one.kind, one.of])).toEqual([["x", "place", "D"], ["y", "place", "D"]]);
  });
  it("has slots, gears, belts and cables", () => {
    const yoke = new Sheet().use("ground", [0, 0]).use("link", [0, 0], [60, 80]).use("link", [60, 200], [60, -60]).use("slot", [60, 80], [60, 150]).use("slider", [60, -20], [160, -20]);
    expect(yoke.lines).toEqual(expect.arrayContaining(["  SB: {slot: [CD, AB], at: B, axis: [C, D]}", "  CD: {points: [C, D, E]}"]));
    const track = new Sheet().use("ground", [0, 0]).use("link", [0, 0], [60, 80]).use("link", [60, 80], [300, 0]).use("slot", [300, 0], [400, 0]);
    expect(track.lines).toContain("  SC: {slot: [ground, BC], at: C, axis: [1, 0]}");
    const geared = fiveBar().use("gear", [0, 0], [500, 0]);
    expect(geared.lines).toContain("  W: {gear: [AC, BE], centres: [A, B], teeth: [20, 20]}");
    expect(geared.drawing.ties[0]?.radii.map((one) => Math.round(one * 1e6))).toEqual([250000, 250000]);
    // A second one between the same centres, and what would join a wheel to itself, is none.
    const { text } = geared.drawing;
    geared.use("gear", [500, 0], [0, 0]).use("belt", [0, 0], [500, 0]).use("gear", [0, 0], [0, 0]).use("gear", [-100, 150], [500, 0]);
    expect(geared.drawing.text).toBe(text);
    // Where nothing turns yet: a wheel on each of two new pins; about a pin that stands, of a carrier, the ground's wheel.
    const bare = new Sheet().use("gear", [0, 0], [120, 0]);
    expect(bare.lines).toEqual(expect.arrayContaining(["  wheel: {points: [A]}", "  B: {revolute: [ground, wheel_2], at: B}", "  W: {gear: [wheel, wheel_2], centres: [A, B], teeth: [20, 20]}"]));
    const planet = new Sheet().use("ground", [0, 0]).use("link", [0, 0], [120, 0]).use("link", [120, 0], [180, 0]).use("gear", [0, 0], [120, 0]);
    expect(planet.lines).toContain("  W: {gear: [ground, BC], centres: [A, B], teeth: [20, 20]}");
    const belt = new Sheet().use("ground", [0, 0]).use("link", [0, 0], [200, 0]).use("link", [200, 0], [300, 0]).use("belt", [0, 0], [200, 0]);
    expect(belt.lines).toContain("  T: {belt: [ground, BC], centres: [A, B], radii: [50, 50], tension: 100 N}");
    const cable = fiveBar().use("cable", [250, 600], [900, 900]).use("ground", [250, 900]).use("cable", [250, 600], [250, 900]);
    expect(cable.lines).toContain("  K: {cable: [CD, ground], at: [D, F], tension: [0 N, 1000 N]}");
  });
  it("shows and changes the numbers of slots, gears, belts and cables", () => {
    const { drawing } = fiveBar().use("gear", [0, 0], [500, 0]);
    const gear: Element = { kind: "joint", name: "W" };
    expect(elementAt(drawing, [0.25, 0.0001], pixel)).toEqual(gear); // where both rims touch
    expect(fieldsOf(drawing, gear).map((one) => one.label)).toEqual(["teeth of AC", "teeth of BE", "backlash"]);
    const typedIn = drawingOf(fieldsOf(drawing, gear)[0]?.write("40") ?? "");
    expect(typedIn.text).toContain("teeth: [40, 20]}");
    expect(typedIn.ties[0]?.radii.map((one) => Math.round(one * 1e6))).toEqual([333333, 166667]);
    expect(rename(drawing, "link", "AC", "wheel")).toContain("{gear: [wheel, BE], centres: [A, B]");
    expect(rename(drawing, "point", "A", "O")).toContain("{gear: [AC, BE], centres: [O, B]");
    expect(drawingOf(removeElement(drawing, { kind: "link", name: "AC" }) ?? "").ties).toEqual([]);
    expect(removeElement(drawing, gear)).toBe(fiveBar().drawing.text);
    const belt = new Sheet().use("belt", [0, 0], [200, 0]).drawing;
    const [radius] = fieldsOf(belt, { kind: "joint", name: "T" });
    expect(radius?.write("30")).toContain("radii: [30, 50], tension: 100 N}");
  });
  it("does nothing where there is nothing to do", () => {
    const sheet = fiveBar();
    const { text } = sheet.drawing;
    sheet.use("link", [0, 0], [500, 0]).use("link", [0, 0], [-200, 300]).use("link", [0, 0], [0, 0]).use("motor", [900, 900]).use("force", [900, 900], [0, 0]).use("mass", [900, 900]).use("slider", [0, 0], [90, 0]).use("spring", [0, 0], [500, 0]).use("ground", [0, 0]).use("remove", [900, 900]);
    expect(sheet.drawing.text).toBe(text);
  });
});

describe("what is drawn", () => {
  it("is dragged: points, arrows, corners, ranges", () => {
    const sheet = fiveBar().use("force", [250, 600], [250, 500]).use("motor", [0, 0]).grip([-200, 300], [-210, 310]).grip([0, 0], [10, -30]);
    expect(placeOf(sheet.drawing, "C")).toEqual([-0.21, 0.31]);
    expect(placeOf(sheet.drawing, "A")).toEqual([0.01, -0.03]);
    sheet.grip([250, 520], [290, 600]);
    expect(sheet.lines).toContain("  - {link: DE, at: D, force: [50, 0]}");
    // A motor's own range is written as soon as it is changed.
    const [low] = handlesOf(sheet.drawing, pixel);
    expect(low?.grip).toEqual({ kind: "range", name: "A", end: 0 });
    sheet.grip([(low?.at[0] ?? 0) * 1000, (low?.at[1] ?? 0) * 1000], [10, 100]);
    expect(sheet.lines).toContain("  A: {angle: [90 deg, 360 deg], of: AC}");
    sheet.use("workspace", [100, 400], [400, 700]).grip([400, 700], [450, 650]);
    expect(sheet.lines).toEqual(expect.arrayContaining(["  x: {place: x, of: D, within: [100, 450]}", "  y: {place: y, of: D, within: [400, 650]}"]));
  });
  it("is dragged where a handle that stands at so many pixels lies over it", () => {
    const sheet = new Sheet().use("ground", [0, 0]).use("ground", [40, 0]).use("link", [0, 0], [0, 300]).use("motor", [0, 0]);
    const [low] = handlesOf(sheet.drawing, pixel);
    expect(low?.at).toEqual([0.04, 0]);
    expect(gripAt(sheet.drawing, [0.04, 0], pixel)).toEqual({ kind: "element", element: { kind: "point", name: "B" } });
    expect(gripAt(sheet.drawing, [0.02, 0], pixel / 2)).toEqual(low?.grip);
  });
  it("keeps a range's ends in their order, and within a turn", () => {
    const { drawing } = fiveBar().use("motor", [0, 0]);
    const own: DrawnCoordinate = { name: "A", kind: "angle", of: "AC", from: undefined, axis: 0, low: 0, high: Math.PI, range: undefined };
    expect(angleText(drawing, own, 1, [0, -1])).toBe("270 deg");
    expect(angleText(drawing, own, 0, [0, -1])).toBe("-90 deg");
    expect(angleText(drawing, own, 0, [-1, -0.001])).toBe("-180 deg");
  });
  it("is typed on the thing itself", () => {
    const { drawing } = fiveBar();
    const type = (element: Element, label: string, value: string): string | undefined => fieldsOf(drawing, element).find((one) => one.label === label)?.write(value);
    expect(type({ kind: "link", name: "AC" }, "length", "7/20 m")).toContain("  AC: {points: [A, C], length: 7/20 m}\n");
    expect(type({ kind: "point", name: "C" }, "x", "-210")).toContain("  C: [-210, 300]\n");
    expect(type({ kind: "point", name: "C" }, "C clearance", "20e-3")).toContain("at: C, clearance: {radial: 20e-3}}\n");
    expect(type({ kind: "joint", name: "C" }, "C clearance", "H7/g6 12 mm")).toContain("at: C, clearance: {fit: H7/g6, diameter: 12 mm}}\n");
    expect(type({ kind: "point", name: "C" }, "x", "1, 2], x: [")).toContain('  C: ["1, 2], x: [", 300]\n');
    expect(fieldsOf(drawing, { kind: "link", name: "AC" })[0]).toMatchObject({ text: "", hint: "360.555", unit: "mm" });
    const given = drawingOf(type({ kind: "link", name: "AC" }, "length", "350") ?? "");
    expect(fieldsOf(given, { kind: "link", name: "AC" })[0]?.write("")).toBe(drawing.text);
    const fitted = drawingOf(type({ kind: "joint", name: "C" }, "C clearance", "H7/g6 12 mm") ?? "");
    expect(fieldsOf(fitted, { kind: "joint", name: "C" })[0]?.text).toBe("H7/g6 12 mm");
    expect(fieldsOf(fitted, { kind: "joint", name: "C" })[0]?.write("0.02")).toContain("at: C, clearance: {radial: 0.02}}");
    expect(fieldsOf(fitted, { kind: "joint", name: "C" })[0]?.write("")).toBe(drawing.text);
    expect(switchesOf(drawing, { kind: "point", name: "A" })[0]?.flip()).toContain("at: A, actuated: true}\n");
  });
  it("is removed with all that hangs on it", () => {
    const sheet = fiveBar().use("motor", [0, 0]).use("force", [250, 600], [250, 500]).use("spring", [-200, 300], [700, 300]).use("workspace", [100, 400], [400, 700]);
    const gone = (element: Element): Drawing => drawingOf(removeElement(sheet.drawing, element) ?? "");
    const noPoint = gone({ kind: "point", name: "D" });
    expect(noPoint.links.map((one) => one.name)).toEqual(["AC", "BE"]);
    expect([noPoint.loads, noPoint.springs, noPoint.coordinates.filter((one) => one.kind === "place"), noPoint.endEffector].map((one) => one?.valueOf())).toEqual([[], [], [], undefined]);
    expect(noPoint.text).not.toMatch(/\bD\b/);
    const noLink = gone({ kind: "link", name: "AC" });
    expect(noLink.points.map((one) => one.name)).toEqual(["A", "B", "C", "D", "E"]); // A is a pin of the ground, C of CD
    expect(noLink.joints.map((one) => one.name)).toEqual(["D", "E", "B"]);
    expect(gone({ kind: "load", index: 0 }).loads).toEqual([]);
    expect(gone({ kind: "joint", name: "A" }).joints).toHaveLength(4);
  });
  it("is found again from its place in the file", () => {
    const { drawing } = fiveBar().use("force", [250, 600], [250, 500]);
    for (const element of [{ kind: "point", name: "C" }, { kind: "link", name: "CD" }, { kind: "joint", name: "E" }, { kind: "load", index: 0 }] as Element[]) {
      expect(elementOf(pathOf(drawing, element))).toEqual(element);
      expect(isThere(drawing, element)).toBe(true);
    }
    expect(elementOf(["units", "length"])).toBeUndefined();
  });
});

describe("names", () => {
  it("change everywhere in the file, and nowhere else", () => {
    const file = `# A holds C
format: 1
name: A and C
parameters: {AC: 3}
workspace: {theta: {angle: [0, 1], of: AC}, s: {stroke: [1, 2], of: C}}
drawn: {A: [0, 0], C: [1, AC], CC: [3, 3]}
links:
  AC: {points: [A, C], lengths: {A-C: 3}}   # A to C
joints:
  A: {revolute: [ground, AC], at: A}
  C: {prismatic: [AC, ground], at: C, axis: [A, C]}
springs: [{joint: A, stiffness: 2, rest: 1}]
end_effector: {link: AC, at: C}
loads: [{link: AC, at: C, force: '30*(A - C) + AC*CC'}]
`;
    const drawing = drawingOf(file);
    const point = rename(drawing, "point", "C", "Tip") ?? "";
    expect(point).toContain("drawn: {A: [0, 0], Tip: [1, AC], CC: [3, 3]}");
    expect(point).toContain("AC: {points: [A, Tip], lengths: {A-Tip: 3}}   # A to C");
    expect(point).toContain("C: {prismatic: [AC, ground], at: Tip, axis: [A, Tip]}");
    expect(point).toContain("at: Tip, force: '30*(A - Tip) + AC*CC'}");
    expect(point).toContain("of: C}}\n");
    expect(point).toContain("# A holds C\nformat: 1\nname: A and C\n");
    expect(rename(drawingOf(point), "point", "Tip", "C")).toBe(file);
    const link = rename(drawing, "link", "AC", "crank") ?? "";
    expect(link).toContain("parameters: {AC: 3}");
    expect(link).toContain("  crank: {points: [A, C]");
    expect(link).toContain("C: {prismatic: [crank, ground]");
    expect(link).toContain("+ AC*CC'");
    const joint = rename(drawing, "joint", "A", "Motor") ?? "";
    expect(joint).toContain("  Motor: {revolute: [ground, AC], at: A}");
    expect(joint).toContain("springs: [{joint: Motor,");
    expect(rename(drawing, "joint", "C", "S")).toContain("of: S}}\n");
    expect(rename(drawing, "parameter", "AC", "h")).toContain("C: [1, h]");
    for (const taken of ["A", "theta", "", "2x", "a b", "null"]) {
      expect(rename(drawing, "point", "C", taken)).toBeUndefined();
      expect(renameFault(drawing, "point", "C", taken)).toContain(`'${taken}'`);
    }
  });
});

describe("pins", () => {
  it("that are taken out let an end go", () => {
    const { drawing } = fiveBar();
    const text = removeElement(drawing, { kind: "joint", name: "D" }) ?? "";
    expect(text).toContain("  DE: {points: [F, E]}\n");
    expect(text).toContain("  F: [250, 600]\n");
    expect(text).not.toContain("  D: {revolute");
  });
});

describe("snapping", () => {
  const { drawing } = fiveBar();
  it("takes points, then lines through them, then the grid", () => {
    expect(snap(drawing, [0.503, 0.004], pixel, { grid: true, lengths: false })).toMatchObject({ point: "B", texts: ["500", "0"] });
    expect(snap(drawing, [0.333, 0.137], pixel, { grid: true, lengths: false }).texts).toEqual(["330", "140"]);
    expect(snap(drawing, [0.3334, 0.3021], pixel, { grid: false, lengths: false }).texts).toEqual(["333", "300"]);
    expect(snap(drawing, [0.503, 0.004], pixel, { grid: true, lengths: false }, undefined, "B").point).toBeUndefined();
  });
  it("takes round lengths and those of other links, exactly", () => {
    const way = snap(drawing, [0.103, 0.002], pixel, { grid: true, lengths: true }, [0, 0]);
    expect(way.length).toBe("100");
    expect(Math.hypot(...way.at)).toBeCloseTo(0.1, 5);
    expect(snap(drawing, [0, -0.359], pixel, { grid: true, lengths: true }, [0, 0]).length).toBe("360.555127546");
    const given = drawingOf(drawing.text.replace("{points: [A, C]}", "{points: [A, C], length: 3601/10}"));
    expect(snap(given, [0, -0.359], pixel, { grid: true, lengths: true }, [0, 0]).length).toBe("3601/10");
  });
});

describe("a parameter", () => {
  it("is moved where it stands alone, and a formula stays", () => {
    const file = "parameters: {d: 5}   # apart\ndrawn: {A: [d, 2*d], B: [0, 0]}\n";
    const drawing = drawingOf(file);
    expect(placeOf(drawing, "A")).toEqual([5, 10]);
    expect(movePoint(drawing, "A", ["7", "8"])).toBe(file.replace("d: 5", "d: 7"));
    expect(movePoint(drawing, "B", ["7", "8"])).toBe(file.replace("[0, 0]", "[7, 8]"));
  });
});

describe("any hand", () => {
  /** Numbers from 0 to 1 that are the same each time. */
  const numbers = (seed: number): (() => number) => {
    let state = seed;
    return () => {
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      return state / 2 ** 32;
    };
  };
  it.each(Array.from({ length: 10 }, (_, k) => k + 1))("leaves a file whose parts know each other, and takes all of it away again (seed %d)", (seed) => {
    const random = numbers(seed);
    const place = (): Point => [Math.round(random() * 6) * 60 - 180, Math.round(random() * 6) * 60 - 180]; // many coincide, and are in line
    const sheet = new Sheet();
    for (let step = 0; step < 18; ++step) {
      const tool = tools[Math.floor(random() * tools.length)];
      if (!tool || (tool.id === "remove" && random() < 0.6)) continue;
      if (tool.takes === "grip") sheet.grip(place(), place());
      else sheet.use(tool.id, place(), tool.takes === "way" ? place() : undefined);
      const { drawing } = sheet;
      expect(parseFile(drawing.text).errors).toEqual([]);
      const points = drawing.points.map((one) => one.name);
      const links = ["ground", ...drawing.links.map((one) => one.name)];
      for (const named of [points, links, drawing.joints.map((one) => one.name)]) expect(new Set(named).size).toBe(named.length);
      for (const link of drawing.links) expect(link.points.filter((name) => !points.includes(name))).toEqual([]);
      for (const joint of drawing.joints) {
        expect(links).toEqual(expect.arrayContaining([joint.from, joint.to]));
        expect(joint.from).not.toBe(joint.to);
        expect(points).toContain(joint.at);
        // A joint is at a point of its links; a guide on a link runs by it.
        if (joint.type === "revolute") for (const end of [joint.from, joint.to]) if (end !== "ground") expect(drawing.links.find((one) => one.name === end)?.points).toContain(joint.at);
      }
      for (const tie of drawing.ties) {
        expect(links).toEqual(expect.arrayContaining([tie.from, tie.to]));
        expect(tie.from).not.toBe(tie.to);
        expect(points).toEqual(expect.arrayContaining(tie.ends));
      }
      for (const load of drawing.loads) expect(drawing.links.find((one) => one.name === load.link)?.points).toContain(load.at);
      for (const spring of drawing.springs) expect(points).toEqual(expect.arrayContaining(spring.at));
      if (drawing.endEffector) expect(drawing.links.find((one) => one.name === drawing.endEffector?.link)?.points).toContain(drawing.endEffector.at);
      for (const own of drawing.coordinates) expect([...points, ...links, ...drawing.joints.map((one) => one.name)]).toContain(own.of);
    }
    for (let left = sheet.drawing; left.points.length > 0; left = drawingOf(removeElement(left, { kind: "point", name: left.points[0]?.name ?? "" }) ?? "")) expect(left.text).not.toBe("");
  });
});

describe("files of others", () => {
  const files = readdirSync(examples).filter((name) => name.endsWith(".yaml"));
  it.each(files)("%s is read, and a drag changes two numbers", (name) => {
    const text = readFileSync(new URL(name, examples), "utf8");
    const drawing = drawingOf(text);
    expect(drawing.coordinates.map((one) => one.name)).toEqual(new ModelText(text).coordinateNames);
    // By its own numbers or by parameters that stand alone; what is a formula stays.
    const point = drawing.points.find((one) => one.fixed && [0, 1].every((axis) => slotOf(text, [one.section, one.name, axis])));
    const moved = point && movePoint(drawing, point.name, ["1", "2"]);
    if (point && moved !== undefined) {
      const [before, after] = [text.split("\n"), moved.split("\n")];
      expect(after.filter((line, k) => line !== before[k]).length).toBeLessThanOrEqual(2);
      expect(placeOf(drawingOf(moved), point.name)).toEqual([drawing.metres, 2 * drawing.metres]);
    }
    const [own] = drawing.coordinates;
    expect(drawingOf(setRangeEnd(drawing, own?.name ?? "", 0, "-7") ?? "").coordinates[0]?.low).toBeLessThan(-0.001);
  });
});
