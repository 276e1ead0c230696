// Mechanisms of textbooks and of other programs' examples, drawn by the hand at their published proportions, where need be
// to the grid, and what is known of their motion.
import { describe, expect, it } from "vitest";
import { shot, rest } from "./program";
import { session } from "./session";
import { Sheet } from "./sheet";

const start = session("");

type Place = [number, number];
type Step = [tool: string, ...places: Place[]];

/** What is typed at the element that lies in a place: the field's label, and its text. */
interface Typed {
  at: Place;
  fields: [label: string, text: string][];
}

interface Textbook {
  name: string;
  /** Where its proportions are published. */
  source: string;
  steps: Step[];
  typed?: Typed;
  coordinates: string[];
  /** The end effector's path over the one coordinate, around where it is drawn, in mm. */
  path?: { within: [number, number]; holds: (places: Place[]) => void };
}

const spread = (values: number[]): number => Math.max(...values) - Math.min(...values);
const column = (places: Place[], axis: 0 | 1): number[] => places.map((at) => at[axis]);

/** The tools that take one place. */
const places = ["ground", "pin", "motor", "mass", "effector", "free"];

const textbook: Textbook[] = [
  {
    name: "Chebyshev's lambda",
    source: "Wikipedia, Chebyshev lambda linkage: a, 2.5 a, 2.5 a + 2.5 a, on a base of 2 a",
    steps: [["ground", [0, 0], [200, 0]], ["link", [0, 0], [0, 100]], ["link", [0, 100], [200, 250]], ["link", [200, 250], [200, 0]], ["plate", [100, 175], [400, 400]], ["motor", [0, 0]], ["force", [400, 400], [400, 330]]],
    coordinates: ["A"],
    path: { within: [(100 * Math.PI) / 180, (260 * Math.PI) / 180], holds: (at) => expect(spread(column(at, 1))).toBeLessThan(0.01 * spread(column(at, 0))) },
  },
  {
    name: "Chebyshev's linkage",
    source: "Wikipedia, Chebyshev linkage: legs of 5 a, a coupler of 2 a, on a base of 4 a",
    steps: [["ground", [0, 0], [320, 0]], ["link", [0, 0], [240, 320]], ["link", [320, 0], [80, 320]], ["link", [240, 320], [80, 320]], ["pin", [160, 320]], ["motor", [0, 0]], ["force", [160, 320], [160, 260]]],
    coordinates: ["A"],
    path: { within: [(40 * Math.PI) / 180, (70 * Math.PI) / 180], holds: (at) => expect(spread(column(at, 1))).toBeLessThan(0.02 * spread(column(at, 0))) },
  },
  {
    name: "Roberts' linkage",
    source: "Wikipedia, Straight line mechanism: three equal isosceles triangles",
    steps: [["ground", [0, 0], [400, 0]], ["link", [0, 0], [100, 240]], ["link", [100, 240], [300, 240]], ["link", [300, 240], [400, 0]], ["plate", [200, 240], [200, 0]], ["motor", [0, 0]], ["force", [200, 0], [200, -60]]],
    coordinates: ["A"],
    path: { within: [(55 * Math.PI) / 180, (80 * Math.PI) / 180], holds: (at) => expect(spread(column(at, 1))).toBeLessThan(0.02 * spread(column(at, 0))) },
  },
  {
    name: "Watt's linkage",
    source: "Wikipedia, Watt's linkage: two equal rods, a short one between their ends, its middle",
    steps: [["ground", [0, 200], [400, 100]], ["link", [0, 200], [200, 200]], ["link", [200, 200], [200, 100]], ["link", [200, 100], [400, 100]], ["pin", [200, 150]], ["motor", [0, 200]], ["force", [200, 150], [260, 150]]],
    coordinates: ["A"],
    path: { within: [-0.25, 0.25], holds: (at) => expect(spread(column(at, 0))).toBeLessThan(0.01 * spread(column(at, 1))) },
  },
  {
    name: "Peaucellier's inversor",
    source: "Wikipedia, Peaucellier–Lipkin linkage: two long rods, a rhombus, a crank as long as its base",
    steps: [["ground", [0, 200], [60, 200]], ["link", [0, 200], [200, 350]], ["link", [0, 200], [200, 50]], ["link", [200, 350], [120, 200]], ["link", [120, 200], [200, 50]], ["link", [200, 350], [280, 200]], ["link", [280, 200], [200, 50]], ["link", [60, 200], [120, 200]], ["motor", [60, 200]], ["force", [280, 200], [220, 200]]],
    coordinates: ["B"],
    path: { within: [-0.6, 0.6], holds: (at) => {
      expect(spread(column(at, 0))).toBeLessThan(1e-9); // a straight line
      expect(spread(column(at, 1))).toBeGreaterThan(100);
    } },
  },
  {
    name: "Scotch yoke",
    source: "Wikipedia, Scotch yoke: a crank's pin in a slot across the way",
    steps: [["ground", [0, 0]], ["link", [0, 0], [60, 80]], ["link", [60, 220], [60, -60]], ["slider", [60, 80], [60, 160]], ["slider", [60, -30], [180, -30]], ["motor", [0, 0]], ["force", [60, 220], [0, 220]]],
    coordinates: ["A"],
    path: { within: [0, 6.28], holds: (at) => {
      expect(spread(column(at, 0))).toBeCloseTo(200, 1); // twice the crank
      expect(spread(column(at, 1))).toBeLessThan(1e-9);
    } },
  },
  {
    name: "Crank and slotted lever",
    source: "Wikipedia, Quick return mechanism: the crank's block on a lever",
    steps: [["ground", [0, 100], [0, 0]], ["link", [0, 100], [30, 140]], ["link", [0, 0], [60, 280]], ["slider", [30, 140], [54, 252]], ["motor", [0, 100]], ["force", [60, 280], [120, 280]]],
    coordinates: ["A"],
    path: { within: [0, 6.28], holds: (at) => expect(spread(column(at, 0))).toBeCloseTo((2 * Math.hypot(60, 280) * 50) / 100, 1) }, // the lever is at its end where the crank is across it
  },
  {
    name: "Trammel of Archimedes",
    source: "Wikipedia, Trammel of Archimedes: a rod on two crossed ways draws an ellipse",
    steps: [["link", [60, 0], [0, 80]], ["slider", [60, 0], [160, 0]], ["slider", [0, 80], [0, 180]], ["plate", [30, 40], [120, -80]], ["motor", [60, 0]], ["force", [120, -80], [180, -80]]],
    coordinates: ["SA"],
    path: { within: [0.03, 0.09], holds: (at) => at.forEach(([x, y]) => expect((x / 200) ** 2 + (y / 100) ** 2).toBeCloseTo(1, 9)) },
  },
  {
    name: "Pantograph",
    source: "Wikipedia, Pantograph: a parallelogram of rods",
    steps: [["ground", [0, 0]], ["link", [0, 0], [160, 320]], ["pin", [80, 160]], ["link", [160, 320], [320, 0]], ["pin", [240, 160]], ["link", [80, 160], [160, 0]], ["link", [160, 0], [240, 160]], ["motor", [0, 0], [160, 320]], ["force", [320, 0], [320, -60]], ["workspace", [60, -150], [440, 150]]],
    coordinates: ["x", "y"],
  },
  {
    name: "Jaw crusher",
    source: "Wikipedia, Crusher: Blake's with two toggles",
    steps: [["ground", [200, 400], [350, 80], [40, 400]], ["link", [200, 400], [230, 400]], ["link", [230, 400], [200, 100]], ["link", [350, 80], [200, 100]], ["link", [40, 400], [60, 80]], ["link", [200, 100], [60, 80]], ["motor", [200, 400]], ["force", [60, 80], [120, 80]]],
    coordinates: ["A"],
  },
  {
    name: "Hoeken's linkage",
    source: "Linkage (the program), a sample: crank 1, base 2, rocker and coupler 2.5, its point at 5",
    steps: [["ground", [0, 0], [80, 0]], ["link", [0, 0], [0, -40]], ["link", [80, 0], [0, 60]], ["link", [0, -40], [0, 60]], ["plate", [0, 30], [0, 160]], ["motor", [0, 0]], ["force", [0, 160], [60, 160]]],
    coordinates: ["A"],
    path: { within: [Math.PI / 2, (3 * Math.PI) / 2], holds: (at) => expect(spread(column(at, 1))).toBeLessThan(0.02 * spread(column(at, 0))) },
  },
  {
    name: "Klann's leg",
    source: "Linkage (the program), a sample, to the grid",
    steps: [["ground", [300, 150], [200, 100], [210, 190]], ["link", [300, 150], [300, 110]], ["link", [200, 100], [200, 160]], ["link", [300, 110], [200, 160]], ["plate", [260, 130], [140, 220]], ["link", [210, 190], [220, 270]], ["link", [140, 220], [220, 270]], ["plate", [180, 245], [-10, 30]], ["motor", [300, 150]], ["force", [-10, 30], [-10, 90]]],
    coordinates: ["A"],
    path: { within: [0, 6.28], holds: (at) => expect(spread(column(at, 0))).toBeGreaterThan(3 * 40) }, // a step is more than three cranks long
  },
  {
    name: "Crank-rocker with a coupler point",
    source: "Pyslvs, README, to the grid",
    steps: [["ground", [0, 0], [360, 0]], ["link", [0, 0], [50, 130]], ["link", [50, 130], [290, 270]], ["link", [290, 270], [360, 0]], ["plate", [170, 200], [130, 270]], ["motor", [0, 0]], ["force", [130, 270], [130, 210]]],
    coordinates: ["A"],
  },
  {
    name: "Crank, slider and rocker",
    source: "Pyslvs, an example, to the grid",
    steps: [["ground", [0, 90], [360, 20]], ["link", [0, 90], [0, 140]], ["link", [0, 140], [200, 0]], ["slider", [200, 0], [300, 0]], ["link", [200, 0], [300, 60]], ["link", [300, 60], [360, 20]], ["plate", [250, 30], [400, 140]], ["motor", [0, 90]], ["force", [400, 140], [400, 80]]],
    coordinates: ["A"],
  },
  {
    name: "Four-bar of equal links",
    source: "Drake, README of its four-bar: links of 4 on a base of 2",
    steps: [["ground", [0, 0], [-100, 0]], ["link", [0, 0], [50, -190]], ["link", [50, -190], [-150, -190]], ["link", [-150, -190], [-100, 0]], ["motor", [0, 0]], ["force", [-150, -190], [-90, -190]]],
    coordinates: ["A"],
  },
  {
    name: "3-RPR",
    source: "CUIK suite, SingFree/3RPR, to the grid",
    steps: [["ground", [0, 0], [160, 0], [0, 100]], ["link", [50, 200], [220, 200]], ["plate", [135, 200], [180, 360]], ["force", [50, 200], [50, 140]], ["workspace", [20, 160], [100, 240]], ["free", [135, 200]], ["cylinder", [0, 0], [50, 200]], ["cylinder", [160, 0], [220, 200]], ["cylinder", [0, 100], [180, 360]]],
    coordinates: ["x", "y", "theta"],
  },
  {
    name: "Slider-crank with a tracer",
    source: "PMKS_Verification, slider_crank_tracer",
    steps: [["ground", [0, 0]], ["link", [0, 0], [80, 40]], ["link", [80, 40], [240, 0]], ["plate", [160, 20], [400, 40]], ["slider", [240, 0], [300, 0]], ["motor", [0, 0]], ["force", [400, 40], [400, -20]]],
    coordinates: ["A"],
  },
  {
    name: "Scotch yoke with a slot",
    source: "Wikipedia, Scotch yoke: the pin itself runs in the slot",
    steps: [["ground", [0, 0]], ["link", [0, 0], [60, 80]], ["link", [60, 220], [60, -60]], ["slot", [60, 80], [60, 160]], ["slider", [60, -30], [180, -30]], ["motor", [0, 0]], ["force", [60, 220], [0, 220]]],
    coordinates: ["A"],
    path: { within: [0, 6.28], holds: (at) => {
      expect(spread(column(at, 0))).toBeCloseTo(200, 1);
      expect(spread(column(at, 1))).toBeLessThan(1e-9);
    } },
  },
  {
    name: "Tusi couple",
    source: "Wikipedia, Tusi couple: a wheel in a ring of twice its size draws a line",
    steps: [["ground", [0, 0]], ["link", [0, 0], [60, 80]], ["link", [60, 80], [160, 80]], ["gear", [60, 80], [0, 0]], ["motor", [0, 0]], ["force", [160, 80], [160, 0]]],
    typed: { at: [60, 130], fields: [["teeth of ground", "-40"]] },
    coordinates: ["A"],
    // On a line through the centre: its direction halves the angle of arm and wheel.
    path: { within: [0, 6.28], holds: (at) => {
      const [x, y] = [160 / Math.hypot(160, 80), 80 / Math.hypot(160, 80)];
      at.forEach((own) => expect(own[0] * y - own[1] * x).toBeCloseTo(0, 9));
      expect(spread(at.map((own) => own[0] * x + own[1] * y))).toBeCloseTo(400, 0);
    } },
  },
  {
    name: "Arm of a drafting machine",
    source: "Wikipedia, Drafting machine: a band over two pulleys keeps the direction of the head; one of its two arms",
    steps: [["ground", [0, 0]], ["link", [0, 0], [150, 200]], ["link", [150, 200], [210, 200]], ["belt", [0, 0], [150, 200]], ["motor", [0, 0]], ["force", [210, 200], [210, 140]]],
    coordinates: ["A"],
    path: { within: [0, 6.28], holds: (at) => at.forEach(([x, y]) => expect(Math.hypot(x - 60, y)).toBeCloseTo(250, 9)) },
  },
  {
    name: "Derrick",
    source: "Wikipedia, Crane: a boom on a hinge that a cable from the mast holds",
    steps: [["ground", [0, 0], [0, 200]], ["link", [0, 0], [250, 100]], ["cable", [0, 200], [250, 100]], ["free", [125, 50]], ["force", [250, 100], [250, 40]]],
    coordinates: ["theta"],
    path: { within: [-1.2, 1.2], holds: (at) => at.forEach(([x, y]) => expect(Math.hypot(x, y)).toBeCloseTo(Math.hypot(250, 100), 9)) },
  },
];

describe("mechanisms of textbooks", () => {
  it.each(textbook)("$name", async ({ name, steps, typed, coordinates, path }) => {
    const sheet = new Sheet(await start({ width: 1500, height: 1000 }));
    const { page } = sheet;
    ++sheet.actions;
    await page.locator("#new-sheet").click();
    await rest(page);
    for (const [tool, ...at] of steps) {
      if (await page.locator(`button[data-tool="${tool}"]`).getAttribute("aria-pressed") !== "true") await sheet.take(tool);
      if (places.includes(tool)) await sheet.click(...at);
      else await sheet.drag(at[0] ?? [0, 0], at[1] ?? [0, 0]);
    }
    if (typed) {
      await sheet.take("select");
      await sheet.click(typed.at);
      for (const [label, words] of typed.fields) {
        ++sheet.actions;
        const field = page.getByLabel(label, { exact: true });
        await field.fill(words);
        await field.press("Enter");
        await rest(page);
      }
    }
    await shot(page, `textbook-${name.toLowerCase().replace(/\W+/g, "-")}`);
    expect(await sheet.said()).toEqual(["", ""]);
    const text = await sheet.file();
    const asked = async (question: string, body: object): Promise<Record<string, unknown>> =>
      page.evaluate(async ([to, question]) => (await fetch(`api/${to}`, { method: "POST", headers: { "Content-Type": "application/json" }, body: question })).json() as Promise<Record<string, unknown>>, [question, JSON.stringify({ text, ...body })] as const);
    const facts = await asked("model", {});
    expect((facts["coordinates"] as { name: string }[]).map((one) => one.name)).toEqual(coordinates);
    expect(await page.locator(".legend-row").count()).toBeGreaterThan(0);
    console.log(`${name}: ${sheet.actions} actions`);
    if (!path) return;
    const [from, to] = path.within;
    const poses = Array.from({ length: 181 }, (_, k) => from + ((to - from) * k) / 180);
    const answer = await asked("sweep", { poses, follow: (facts["end_effector"] as { at: string }).at });
    const way = (answer["places"] as (Place | null)[]).filter((at) => at !== null).map(([x, y]): Place => [x * 1000, y * 1000]);
    expect(way.length).toBeGreaterThan(90);
    path.holds(way);
  });
});
