// `clearloci loci --export html`: one file, opened from disk, that asks nobody for anything.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Browser, BrowserContext, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { launch, program, shot, source } from "./program";

let browser: Browser;
let context: BrowserContext | undefined;
let requests: string[] = [];
let faults: string[] = [];
const folder = mkdtempSync(join(tmpdir(), "clearloci-html-"));

beforeAll(async () => {
  browser = await launch();
});
afterAll(async () => {
  await browser.close();
});
afterEach(async () => {
  await context?.close();
});

async function openFromDisk(name: string): Promise<Page> {
  execFileSync(program, ["loci", join(source, "examples", `${name}.yaml`), "--export", "html", "--quiet", "-o", join(folder, name)]);
  const path = join(folder, name, "loci.html");
  expect(readFileSync(path, "utf8")).toContain("default-src 'none'");
  context = await browser.newContext({ viewport: { width: 1100, height: 760 }, offline: true });
  const page = await context.newPage();
  requests = [];
  faults = [];
  page.on("request", (request) => requests.push(request.url()));
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  await page.goto(pathToFileURL(path).href);
  await page.locator(".legend-row").first().waitFor();
  return page;
}

const image = async (page: Page): Promise<string> => page.locator("canvas.layer").first().evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
const alone = (): void => {
  expect(requests.filter((url) => !url.startsWith("file:"))).toEqual([]);
  expect(requests).toHaveLength(1);
  expect(faults).toEqual([]);
};

describe("a page of loci from disk", () => {
  it("shows curves that are pointed at, zoomed and switched", async () => {
    const page = await openFromDisk("five_bar");
    const before = await image(page);
    const box = await page.locator(".viewer-stage").boundingBox();
    const [x, y] = [(box?.x ?? 0) + (box?.width ?? 0) / 2, (box?.y ?? 0) + (box?.height ?? 0) / 2];
    // Somewhere along a line across the picture there is a curve.
    for (let k = -200; k <= 200 && (await page.locator(".curve-reading").count()) === 0; k += 4) await page.mouse.move(x + k, y - 60);
    expect(await page.locator(".curve-reading").textContent()).toMatch(/= 0/);
    await page.mouse.wheel(0, -400);
    await expect.poll(() => image(page)).not.toBe(before);
    const zoomed = await image(page);
    await page.locator(".legend-row input").first().uncheck();
    await expect.poll(() => image(page)).not.toBe(zoomed);
    await shot(page, "export-five-bar");
    alone();
  });

  it("shows the marks of a linkage", async () => {
    const page = await openFromDisk("four_bar");
    const before = await image(page);
    await page.locator(".viewer-stage").focus();
    await page.keyboard.press("+");
    await expect.poll(() => image(page)).not.toBe(before);
    await shot(page, "export-four-bar");
    alone();
  });

  it("shows surfaces that are turned", async () => {
    const page = await openFromDisk("gough_stewart");
    await expect.poll(async () => (await image(page)).length).toBeGreaterThan(20_000);
    const before = await image(page);
    const box = await page.locator(".viewer-stage").boundingBox();
    const [x, y] = [(box?.x ?? 0) + (box?.width ?? 0) / 2, (box?.y ?? 0) + (box?.height ?? 0) / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 90, y + 30, { steps: 4 });
    await page.mouse.up();
    await expect.poll(() => image(page)).not.toBe(before);
    await shot(page, "export-gough-stewart");
    alone();
  });
});
