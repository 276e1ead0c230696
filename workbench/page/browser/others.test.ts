// Other mechanisms on the page: one, two and three coordinates, in the plane and in space.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Locator, Page } from "playwright-core";
import { describe, expect, it } from "vitest";
import { drag, exact, onPage, rest, shot, source, type } from "./program";
import { session } from "./session";

const start = session("five_bar.yaml");

async function example(name: string): Promise<Page> {
  const page = await start();
  await page.getByLabel("Open an example").selectOption(name);
  await rest(page);
  return page;
}

const image = async (page: Page, layer: string): Promise<string> => page.locator(`canvas[data-layer="${layer}"]`).evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());

/** Where the ball of the pose stands on the page: the stage says so. */
async function ball(page: Page): Promise<[number, number]> {
  return page.evaluate(() => {
    const stage = document.querySelector<HTMLElement>(".stage.space");
    const [x = 0, y = 0] = JSON.parse(stage?.dataset["pose"] ?? "[]") as number[];
    const box = stage?.getBoundingClientRect();
    return [(box?.left ?? 0) + x, (box?.top ?? 0) + y];
  });
}

describe("one coordinate", () => {
  it("shows the cycle with its loci as marks, and the linkage moving", async () => {
    const page = await example("four_bar.yaml");
    const strip = page.getByRole("slider", { name: "The coordinate of the linkage" });
    expect(await strip.isVisible()).toBe(true);
    const [linkage, marks] = [await image(page, "mechanism"), await image(page, "cycle")];
    const box = await strip.boundingBox();
    await page.mouse.click((box?.x ?? 0) + 0.7 * (box?.width ?? 0), (box?.y ?? 0) + 30);
    await rest(page);
    expect(await image(page, "mechanism")).not.toBe(linkage);
    expect(await image(page, "cycle")).not.toBe(marks);
    await strip.focus();
    const at = await strip.getAttribute("aria-valuenow");
    await page.keyboard.press("ArrowRight");
    await rest(page);
    expect(Number(await strip.getAttribute("aria-valuenow"))).toBeCloseTo(Number(at) + 0.02 * Math.PI, 6);
    await expect.poll(() => page.locator(".plot canvas").count()).toBeGreaterThanOrEqual(3);
    await shot(page, "four-bar");
  });
});

describe("a spring to the ground", () => {
  it("is shown whole", async () => {
    const page = await example("five_bar_preloaded.yaml");
    await page.getByText("Points on the ground", { exact: true }).click();
    await type(page, "H y", "1.7");
    await page.locator(".stage:not(.space)").first().press("0");
    const [x, y] = await onPage(page, [await exact(page, "H x").inputValue().then(Number), 1.7]);
    const box = await page.locator(".stage:not(.space)").first().boundingBox();
    expect(x).toBeGreaterThan(box?.x ?? Infinity);
    expect(y).toBeGreaterThan(box?.y ?? Infinity);
  });
});

describe("three coordinates", () => {
  it("shows surfaces that turn, and a plane that slices them", async () => {
    const page = await example("gough_stewart.yaml");
    const stage = page.locator(".stage.space");
    await expect.poll(() => stage.isVisible()).toBe(true);
    const first = await image(page, "space");
    expect(first.length).toBeGreaterThan(20_000); // more than an empty canvas
    await shot(page, "gough-stewart");
    await stage.focus();
    await page.keyboard.press("ArrowRight");
    await expect.poll(() => image(page, "space")).not.toBe(first);
    const turned = await image(page, "space");
    // The ball stands where the camera looks, and the pose follows it.
    const before = await page.getByLabel("z of the pose").first().inputValue();
    const [x, y] = await ball(page);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 20, y - 60, { steps: 4 });
    await page.mouse.up();
    await rest(page);
    expect(Number(await page.getByLabel("z of the pose").first().inputValue())).toBeGreaterThan(Number(before));
    expect(await page.evaluate(() => document.querySelector<HTMLElement>(".stage.space")?.dataset["grip"])).toBeUndefined();
    await page.getByLabel("slice", { exact: true }).check();
    await rest(page);
    await expect.poll(() => image(page, "space")).not.toBe(turned);
    await shot(page, "gough-stewart-slice");
  });
});

describe("a file in mm and degrees, whose legs are written once", () => {
  it("has a slider for every value of the block", async () => {
    const page = await example("hexapod.yaml");
    expect(await exact(page, "z").inputValue()).toBe("450");
    const before = await image(page, "loci");
    await type(page, "a, i = 2", "110");
    expect(await page.locator(".notice.fault").allTextContents()).toEqual([]);
    expect(await image(page, "loci")).not.toBe(before);
    await shot(page, "hexapod");
  });

  it("is dragged and given tasks in its own units", async () => {
    const page = await example("minitaur_leg.yaml");
    await drag(page, [0, 0], [0.02, 0.01]);
    expect(Number(await exact(page, "A1 x").inputValue())).toBeCloseTo(20, 0);
    expect(await page.locator(".notice.fault").allTextContents()).toEqual([]);
    await page.getByText("Task", { exact: true }).click();
    await page.getByRole("button", { name: "circle", exact: true }).click();
    await page.getByLabel("margin", { exact: true }).fill("0.5"); // mm
    await page.getByLabel("margin", { exact: true }).press("Enter");
    await expect.poll(() => page.locator(".verdict").textContent()).toMatch(/^(Verified|Refuted)/);
    await shot(page, "minitaur-leg");
  });
});

describe("a task over other than two lengths", () => {
  const verdict = (page: Page): Locator => page.locator(".verdict");
  const draw = async (page: Page, kind = "box"): Promise<void> => {
    await page.getByText("Task", { exact: true }).click();
    await page.getByRole("button", { name: kind, exact: true }).click();
    await rest(page);
  };
  const set = async (page: Page, name: string, value: string): Promise<void> => {
    await page.getByLabel(`${name} of the task,`).nth(value.startsWith(">") ? 1 : 0).fill(value.replace(">", ""));
    await page.keyboard.press("Enter");
    await rest(page);
  };

  it("is a range of the one coordinate, on the strip of the cycle", async () => {
    const page = await example("four_bar.yaml");
    await draw(page);
    await set(page, "theta", "10");
    await set(page, "theta", ">40");
    await expect.poll(() => verdict(page).textContent()).toMatch(/^(Verified.*deg|Refuted)/s);
    await shot(page, "four-bar-task");
    // All the way round it meets its loci.
    await set(page, "theta", "0");
    await set(page, "theta", ">360");
    await expect.poll(() => verdict(page).textContent()).toContain("Refuted");
  });

  it("is a box with an angle, and of six coordinates, of which there are no loci", async () => {
    const page = await example("gough_stewart_poses.yaml");
    expect(await page.locator(".notice").textContent()).toContain("one to three free coordinates");
    expect(await page.locator(".inset").isVisible()).toBe(true);
    await draw(page);
    expect(await page.locator(".range-row").count()).toBe(6);
    await expect.poll(() => verdict(page).textContent()).toMatch(/^(Verified|Refuted|Undecided)/);
    await shot(page, "six-coordinates");
  });
});

describe("a trajectory", () => {
  it("is played back, with its contact losses", async () => {
    const page = await example("pick_and_place/manipulator.yaml");
    await page.getByText("Trajectory", { exact: true }).click();
    await page.getByRole("button", { name: "The example's path" }).click();
    await rest(page);
    const player = page.getByLabel("Time");
    await expect.poll(() => player.isVisible()).toBe(true);
    expect(await page.locator("details:has-text('Trajectory') li").count()).toBeGreaterThan(2);
    const before = await image(page, "mechanism");
    await player.fill("0.3");
    await rest(page);
    expect(await image(page, "mechanism")).not.toBe(before);
    await page.locator(".player").getByRole("button", { name: "Play" }).click();
    await expect.poll(async () => Number(await player.inputValue())).not.toBe(0.3);
    await page.getByRole("button", { name: "Pause" }).click();
    await shot(page, "trajectory");
  });
});

describe("every shipped example", () => {
  // Those that take seconds to trace are opened by the tests above, and by those of the program.
  const slow = /delta|jansen_leg|klann_leg|five_bar_coupler|three_ruu|three_rrr|gough_stewart.yaml|gough_stewart_poses|hexapod|four_bar/;
  const names = readdirSync(join(source, "examples")).filter((name) => name.endsWith(".yaml") && !slow.test(name));
  it("is drawn, or said to be incomplete", async () => {
    const page = await start();
    for (const name of names) {
      await page.getByLabel("Open an example").selectOption(name);
      await rest(page);
      const title = /^name: *(.+?)\s*(#.*)?$/m.exec(readFileSync(join(source, "examples", name), "utf8"))?.[1] ?? "";
      expect(await page.locator("h1").textContent(), name).toBe(title);
      const faults = await page.locator(".notice.fault").allTextContents();
      expect(faults, name).toEqual([]);
      const incomplete = await page.getByText("incomplete: stopped at the time limit").count();
      expect((await page.locator(".legend-row").count()) + incomplete, name).toBeGreaterThan(0);
    }
  });
});
