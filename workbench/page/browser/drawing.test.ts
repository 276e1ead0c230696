// A mechanism from nothing, and one of a file, changed by the hand.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { describe, expect, it } from "vitest";
import { onPage, rest, shot, source } from "./program";
import { session } from "./session";
import { Sheet } from "./sheet";

const start = session("");

async function blank(options = {}): Promise<Sheet> {
  const sheet = new Sheet(await start(options));
  ++sheet.actions;
  await sheet.page.locator("#new-sheet").click();
  await rest(sheet.page);
  return sheet;
}

async function fiveBar(sheet: Sheet): Promise<void> {
  await sheet.take("ground");
  await sheet.click([0, 0], [200, 0]);
  await sheet.take("link");
  await sheet.drag([0, 0], [-100, 150]);
  await sheet.drag([-100, 150], [100, 300]);
  await sheet.drag([100, 300], [300, 150]);
  await sheet.drag([300, 150], [200, 0]);
}

async function saved(page: Page): Promise<string> {
  const waiting = page.waitForEvent("download");
  await page.locator("#save").click();
  return readFileSync(await (await waiting).path(), "utf8");
}

async function give(page: Page, name: string, text: string): Promise<void> {
  await page.locator("#open-file").setInputFiles({ name, mimeType: "application/yaml", buffer: Buffer.from(text) });
  await rest(page);
}

const legend = (page: Page): Promise<number> => page.locator(".legend-row").count();
const picture = (page: Page): Promise<string> => page.locator('canvas[data-layer="sheet"]').evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());

describe("the gallery", () => {
  it("shows twelve mechanisms, each of which opens", async () => {
    const page = await start();
    await page.locator(".gallery[data-painted='12']").waitFor();
    expect(await page.locator(".card").count()).toBe(12);
    await shot(page, "gallery");
    const blankCards = await page.locator(".card canvas").evaluateAll((canvases) => (canvases as HTMLCanvasElement[]).filter((canvas) => !canvas.getContext("2d")?.getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value !== 0)).length);
    expect(blankCards).toBe(0);
    await page.locator('[data-example="klann_leg.yaml"]').click();
    await rest(page);
    expect(await page.locator("h1").textContent()).toContain("Klann");
    expect(await page.locator(".gallery").isVisible()).toBe(false);
    await page.locator("#examples").selectOption("gallery");
    await rest(page);
    expect(await page.locator(".gallery").isVisible()).toBe(true);
    await page.getByRole("button", { name: "Undo" }).click();
    await rest(page);
    expect(await page.locator("h1").textContent()).toContain("Klann");
  });
  it("fits a narrow window and a dark one", async () => {
    const page = await start({ width: 400, height: 844, dark: true });
    await page.locator(".gallery[data-painted='12']").waitFor();
    await shot(page, "gallery-narrow-dark");
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(400);
  });
});

describe("the hand on the sheet", () => {
  it("puts back with Escape what it drags", async () => {
    const sheet = await blank();
    const { page } = sheet;
    await fiveBar(sheet);
    await sheet.take("select");
    const before = await sheet.file();
    await page.mouse.move(...(await sheet.at([-100, 150])));
    await page.mouse.down();
    await page.mouse.move(...(await sheet.at([-150, 120])), { steps: 5 });
    await rest(page);
    expect(await sheet.file()).not.toBe(before);
    await page.keyboard.press("Escape");
    await page.mouse.move(...(await sheet.at([-180, 90])), { steps: 5 });
    await page.mouse.up();
    await rest(page);
    expect(await sheet.file()).toBe(before);
  });

  it("says why a name is refused", async () => {
    const sheet = await blank();
    const { page } = sheet;
    await fiveBar(sheet);
    await sheet.take("select");
    await sheet.click([-100, 150]);
    const name = page.locator('.on-element input[name="name"]');
    await name.fill("A");
    await name.press("Enter");
    expect(await page.locator(".on-element .fault").textContent()).toBe("'A' is the name of another one");
  });
});

describe("a five-bar from nothing", () => {
  it("says what is missing at the element, shows loci, and ends in a proven task, in under forty actions", async () => {
    const sheet = await blank();
    const { page } = sheet;
    expect((await sheet.said())[0]).toContain("ground pin");
    await sheet.take("ground");
    await sheet.click([0, 0], [200, 0]);
    expect(await sheet.said()).toEqual(["Draw a link from A", "point A"]);
    await sheet.take("link");
    await sheet.drag([0, 0], [-100, 150]);
    await sheet.click([-100, 150], [100, 300]); // a link by two clicks
    await sheet.drag([100, 300], [300, 150]);
    expect(await sheet.said()).toEqual(["No motor: put one at a joint", "joint A"]);
    await sheet.drag([300, 150], [200, 0]);
    await sheet.take("motor");
    await sheet.click([0, 0]);
    await sheet.take("force");
    await sheet.drag([100, 300], [100, 200]);
    const [words, element] = await sheet.said();
    expect(words).toMatch(/move.* freely: 2 freedoms, 1 coordinate, 1 motor; join one of them to another link, actuate another joint/);
    expect(element).toMatch(/^link /);
    await shot(page, "drawing-refused");
    await sheet.take("motor");
    await sheet.click([200, 0]);
    expect((await sheet.said())[0]).toBe("");
    expect(await legend(page)).toBeGreaterThan(3); // over the motors' angles, in a corner
    expect(await page.locator(".loci-inset").isVisible()).toBe(true);
    await shot(page, "drawing-angles");
    await sheet.take("workspace");
    await sheet.drag([-150, 50], [350, 340]);
    expect((await sheet.said())[0]).toBe("");
    expect(await legend(page)).toBeGreaterThan(3);
    await shot(page, "drawing-five-bar");
    ++sheet.actions;
    await page.getByText("Task", { exact: true }).click();
    await sheet.press("box");
    const verdict = page.locator(".verdict");
    await expect.poll(() => verdict.textContent()).toMatch(/Verified|Refuted/);
    if ((await verdict.textContent())?.includes("Refuted")) {
      await sheet.press("Fit nearest");
      await expect.poll(() => verdict.textContent()).toContain("Verified");
    }
    await shot(page, "drawing-task");
    expect(sheet.actions).toBeLessThan(40);
    expect(await saved(page)).toContain("  D: {revolute: [CD, DE], at: D}\n");
  });

  it("is undone step by step to the empty sheet, and redone", async () => {
    const sheet = await blank();
    const empty = await sheet.file();
    await fiveBar(sheet);
    const whole = await sheet.file();
    for (let k = 0; k < 6; ++k) await sheet.press("Undo");
    expect(await sheet.file()).toBe(empty);
    for (let k = 0; k < 6; ++k) await sheet.press("Redo");
    expect(await sheet.file()).toBe(whole);
  });

  it("is moved, measured and typed on the thing itself", async () => {
    const sheet = await blank();
    const { page } = sheet;
    await fiveBar(sheet);
    await sheet.take("select");
    await sheet.drag([-100, 150], [-120, 160]);
    expect(await sheet.file()).toContain("  C: [-120, 160]\n");
    await sheet.click([100, 100]); // away
    expect(await page.locator(".on-element").isVisible()).toBe(false);
    await sheet.click([-10, 230]); // halfway along CD
    expect(await page.locator(".on-element strong").textContent()).toBe("Link CD");
    await page.getByLabel("length", { exact: true }).fill("255");
    await page.getByLabel("length", { exact: true }).press("Enter");
    await rest(page);
    expect(await sheet.file()).toContain("  CD: {points: [C, D], length: 255}\n");
    await sheet.click([300, 150]);
    await page.getByLabel("x", { exact: true }).fill("310");
    await page.getByLabel("x", { exact: true }).press("Enter");
    await page.getByLabel("E clearance", { exact: true }).fill("H7/g6 12");
    await page.getByLabel("E clearance", { exact: true }).press("Enter");
    await rest(page);
    expect(await sheet.file()).toContain("  E: [310, 150]\n");
    expect(await sheet.file()).toContain("at: E, clearance: {fit: H7/g6, diameter: 12}}");
    await shot(page, "drawing-typed");
    await page.getByLabel("name", { exact: true }).fill("Tip");
    await page.getByLabel("name", { exact: true }).press("Enter");
    await rest(page);
    expect(await sheet.file()).toContain("  DE: {points: [D, Tip]}\n");
    await page.locator(".on-element").getByRole("button", { name: "Delete" }).click();
    await rest(page);
    expect(await sheet.file()).not.toMatch(/\bTip\b/);
  });
});

describe("other mechanisms", () => {
  it("a slider-crank drives its cycle, which plays", async () => {
    const sheet = await blank();
    const { page } = sheet;
    await sheet.take("ground");
    await sheet.click([0, 0]);
    await sheet.take("link");
    await sheet.drag([0, 0], [40, 60]);
    await sheet.drag([40, 60], [250, 0]);
    await sheet.take("slider");
    await sheet.drag([250, 0], [330, 0]);
    await sheet.take("motor");
    await sheet.click([0, 0]);
    await sheet.take("force");
    await sheet.drag([250, 0], [150, 0]);
    expect((await sheet.said())[0]).toBe("");
    await expect.poll(() => legend(page)).toBeGreaterThan(0);
    await shot(page, "drawing-slider-crank");
    const before = await picture(page);
    await page.locator(".stage-column .play button").click();
    await expect.poll(() => page.locator(".stage-column .losses").textContent(), { timeout: 30_000 }).toContain("vanishes");
    await shot(page, "drawing-play");
    await page.locator(".stage-column .play button").click();
    await rest(page);
    expect(await picture(page)).not.toBe(before);
  });

  it("two cylinders, by their strokes", async () => {
    const sheet = await blank();
    await sheet.take("ground");
    await sheet.click([0, 0], [400, 0]);
    await sheet.take("cylinder");
    await sheet.drag([0, 0], [200, 250]);
    await sheet.drag([400, 0], [200, 250]);
    await sheet.take("force");
    await sheet.drag([200, 250], [260, 180]);
    expect((await sheet.said())[0]).toBe("");
    expect(await sheet.file()).toContain("  SBC: {prismatic: [cylinder_2, rod_2], at: C, axis: [B, C], actuated: true}\n");
    await expect.poll(() => legend(sheet.page)).toBeGreaterThan(0);
    await shot(sheet.page, "drawing-cylinders");
  });

  it("a four-bar with a coupler point, a spring and a mass, by the angle of its crank", async () => {
    const sheet = await blank();
    await sheet.take("ground");
    await sheet.click([0, 0], [200, 0]);
    await sheet.take("link");
    await sheet.drag([0, 0], [30, 80]);
    await sheet.drag([30, 80], [240, 150]);
    await sheet.drag([240, 150], [200, 0]);
    await sheet.take("plate");
    await sheet.drag([135, 115], [120, 210]);
    await sheet.take("spring");
    await sheet.drag([120, 210], [200, 0]);
    await sheet.take("mass");
    await sheet.click([220, 75]);
    await sheet.take("motor");
    await sheet.click([0, 0]);
    await sheet.take("effector");
    await sheet.click([120, 210]);
    await sheet.take("free");
    await sheet.click([15, 40]);
    expect((await sheet.said())[0]).toBe("");
    const file = await sheet.file();
    expect(file).toContain("  theta: {angle: [0 deg, 360 deg], of: AC}\n");
    expect(file).toContain("end_effector: {link: CD, at: E}\n");
    await expect.poll(() => legend(sheet.page)).toBeGreaterThan(0);
    await shot(sheet.page, "drawing-four-bar");
  });
});

describe("another program's file", () => {
  const folder = join(source, "tests", "mechanism", "import", "files");
  const opened = async (page: Page, path: string): Promise<void> => give(page, path.split("/").at(-1) ?? "", readFileSync(join(folder, path), "utf8"));

  it("is opened, edited by the hand and on the thing itself, saved, and opened again", async () => {
    const page = await start();
    await opened(page, "linkage/tracer.linkage2"); // in inches
    const sheet = new Sheet(page);
    const imported = await sheet.file();
    expect(imported).toMatch(/^# From tracer\.linkage2, Linkage\.\n# - /);
    await expect.poll(() => legend(page)).toBeGreaterThan(0);
    await shot(page, "imported");
    await sheet.press("Draw");
    await sheet.take("select");
    await sheet.drag([25.4, 50.8], [10, 60]); // the end of the crank, from (1, 2) in
    const dragged = await sheet.file();
    expect(dragged).toMatch(/ {2}C1: \[0\.\d+, 2\.\d+\]\n/);
    expect(dragged.replace(/ {2}C1: .*\n/, "")).toBe(imported.replace(/ {2}C1: .*\n/, "")); // comments and all
    await sheet.click([114.3, 50.8]); // halfway along the rocker
    await page.getByLabel("length", { exact: true }).fill("4.2");
    await page.getByLabel("length", { exact: true }).press("Enter");
    await rest(page);
    expect(await sheet.said()).toEqual(["", ""]);
    await shot(page, "imported-edited");
    const text = await saved(page);
    expect(text).toContain("  L2: {points: [C2, C3], length: 4.2}\n");
    await give(page, "saved.yaml", text);
    expect(await sheet.file()).toBe(text);
    await expect.poll(() => legend(page), { timeout: 30_000 }).toBeGreaterThan(0);
  });

  it("with a slot is edited along it, saved, and opened again", async () => {
    const page = await start();
    await opened(page, "linkage/slot.linkage2");
    const sheet = new Sheet(page);
    const imported = await sheet.file();
    expect(imported).toContain("C1_slot: {slot: [L1, L0], at: C1, axis: [C2, C3]");
    await expect.poll(() => legend(page)).toBeGreaterThan(0);
    await sheet.press("Draw");
    await sheet.take("select");
    await sheet.drag([127, 101.6], [150, 120]); // the end of the lever, from (5, 4) in: the pin leaves its slot
    expect((await sheet.said())[0]).toBe("");
    await page.getByRole("button", { name: "Undo" }).click();
    await rest(page);
    expect(await sheet.file()).toBe(imported);
    await shot(page, "imported-slot");
    await sheet.click([25.4, 50.8]); // the pin in the slot
    const gap = page.locator(".on-element").getByLabel("C1_slot gap", { exact: true });
    await gap.fill("0.002");
    await gap.press("Enter");
    await rest(page);
    expect(await sheet.said()).toEqual(["", ""]);
    const text = await saved(page);
    expect(text).toContain("axis: [C2, C3], clearance: {gap: 0.002}}");
    await give(page, "saved.yaml", text);
    expect(await sheet.file()).toBe(text);
    await expect.poll(() => legend(page), { timeout: 30_000 }).toBeGreaterThan(0);
  });

  it("with gears shows their pitch circles, whose teeth are typed", async () => {
    const page = await start();
    await opened(page, "linkage/gears.linkage2");
    const sheet = new Sheet(page);
    await expect.poll(() => legend(page)).toBeGreaterThan(0);
    await sheet.press("Draw");
    await sheet.take("select");
    await sheet.click([152.4, -101.6]); // on the rim of the second wheel, 4 in below its centre
    await page.getByLabel("teeth of L0", { exact: true }).fill("25");
    await page.getByLabel("teeth of L0", { exact: true }).press("Enter");
    await rest(page);
    const [words, element] = await sheet.said();
    expect(words).toContain("turns link L0 by -8/5 of its angle");
    expect(element).not.toBe("");
    await shot(page, "imported-gears");
    await page.getByLabel("teeth of L1", { exact: true }).fill("75");
    await page.getByLabel("teeth of L1", { exact: true }).press("Enter");
    await rest(page);
    expect(await sheet.said()).toEqual(["", ""]);
    expect(await saved(page)).toContain("teeth: [25, 75]}");
  });

  it("that cannot be read is refused by name, and the last mechanism stays", async () => {
    const page = await start({ width: 400, height: 844 });
    await opened(page, "pmks/six_bar.txt");
    await expect.poll(() => page.locator("h1").textContent(), { timeout: 30_000 }).toBe("PMKS+");
    await expect.poll(() => legend(page), { timeout: 30_000 }).toBeGreaterThan(0);
    await shot(page, "imported-narrow");
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(400);
    await opened(page, "linkage/curved_slot.linkage2");
    await expect.poll(() => page.locator(".said").textContent()).toContain("slides along an arc");
    expect(await page.locator("h1").textContent()).toBe("PMKS+");
  });
});

describe("a file", () => {
  const original = readFileSync(join(source, "examples", "five_bar.yaml"), "utf8");

  it("that is opened is edited by the hand and saved, with its comments", async () => {
    const page = await start();
    await give(page, "mine.yaml", original);
    expect(await page.locator("h1").textContent()).toContain("5R");
    const sheet = new Sheet(page);
    await sheet.press("Draw");
    await sheet.take("select");
    await shot(page, "drawing-opened");
    // d is a parameter: the right base point is typed in the file instead, and drawn.
    await sheet.file();
    const text = page.locator("#file-text");
    await text.fill(original.replace("L: 0.5 ", "L: 7/20 "));
    await rest(page);
    expect(await saved(page)).toBe(original.replace("L: 0.5 ", "L: 7/20 "));
    await text.fill(original.replace("L: 0.5 ", "L: 0,5 "));
    await rest(page);
    expect((await sheet.said())[0]).toMatch(/^mine\.yaml:\d+:\d+: /);
    await text.fill(original);
    await rest(page);
    expect((await sheet.said())[0]).toBe("");
  });

  it("with constructions takes a spring and a new link from where its points are", async () => {
    const page = await start();
    await give(page, "mine.yaml", original);
    const sheet = new Sheet(page);
    await sheet.press("Draw");
    const places = JSON.parse((await page.locator(".sheet").getAttribute("data-points")) ?? "{}") as Record<string, [number, number]>;
    const at = (name: string): [number, number] => [(places[name]?.[0] ?? 0) * 1000, (places[name]?.[1] ?? 0) * 1000];
    await sheet.take("spring");
    await sheet.drag(at("B1"), at("A2"));
    expect(await sheet.said()).toEqual(["", ""]);
    expect(await saved(page)).toContain("springs:\n  - {links: [A1B1, ground], at: [B1, A2], stiffness: 1000 N/m, free_length: 0}\n");
    await expect.poll(() => legend(page)).toBeGreaterThan(0);
  });

  it("with constructions is moved by any of its points, on the sheet and among the loci", async () => {
    const page = await start();
    await give(page, "mine.yaml", original);
    const sheet = new Sheet(page);
    await sheet.press("Draw");
    const where = async (name: string): Promise<[number, number]> => {
      const places = JSON.parse((await page.locator(".sheet").getAttribute("data-points")) ?? "{}") as Record<string, [number, number]>;
      return [(places[name]?.[0] ?? 0) * 1000, (places[name]?.[1] ?? 0) * 1000];
    };
    await sheet.take("select");
    const before = await where("B1");
    await sheet.drag(before, [before[0] - 60, before[1] + 40]);
    const after = await where("B1");
    expect(Math.hypot(after[0] - before[0], after[1] - before[1])).toBeGreaterThan(20);
    expect(Math.hypot(after[0], after[1])).toBeCloseTo(500, 3); // still on its crank
    expect(await saved(page)).toBe(original);
    await sheet.press("Draw");
    const [x, y] = await onPage(page, [after[0] / 1000, after[1] / 1000]);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 20, y + 30, { steps: 5 });
    await page.mouse.up();
    await rest(page);
    await sheet.press("Draw");
    expect(Math.hypot((await where("B1"))[0] - after[0], (await where("B1"))[1] - after[1])).toBeGreaterThan(5);
  });

  it("that is dropped is opened, and one of no known form is named", async () => {
    const page = await start();
    await page.evaluate((text) => {
      const data = new DataTransfer();
      data.items.add(new File([text], "dropped.yaml"));
      document.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    }, original);
    await expect.poll(() => page.locator("h1").textContent()).toContain("5R");
    await rest(page);
    await give(page, "notes.txt", "nothing");
    await expect.poll(() => page.locator(".said").textContent()).toContain("notes.txt");
  });

  it("is drawn in a narrow window", async () => {
    const sheet = await blank({ width: 400, height: 844 });
    await sheet.take("ground");
    await sheet.click([0, 0], [150, 0]);
    await sheet.take("link");
    await sheet.drag([0, 0], [-60, 100]);
    await shot(sheet.page, "drawing-narrow");
    expect(await sheet.page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(400);
    expect(await sheet.file()).toContain("  AC: {points: [A, C]}\n");
    await sheet.take("gear");
    await sheet.drag([0, 0], [150, 0]);
    await shot(sheet.page, "drawing-narrow-gear");
    expect(await sheet.file()).toContain("  W: {gear: [AC, wheel], centres: [A, B], teeth: [20, 20]}\n");
    expect(await sheet.page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(400);
  });
});
