// From the move of a slider to the painted loci of the 5R, of the end effector to the painted pose, and until the page is
// open: node tools/run.mjs browser/latency.ts, with CLEARLOCI_PROGRAM set. A move is made when the one before is painted
// and the page rests; times are the page's own marks, from the event to the frame after the drawing.
import type { Page } from "playwright-core";
import { launch, open, rest, Served } from "./program";

const moves = Number(process.env["CLEARLOCI_MOVES"] ?? 100);
/** What docs/workbench.md promises, in ms. */
const aims = { loci: 50, pose: 33, open: 1000 };

/** Durations of the marks of this name that `act` leaves, one a move, smallest first. */
async function measure(page: Page, name: string, act: (k: number) => Promise<void>): Promise<number[]> {
  const times: number[] = [];
  for (let k = 0; k < moves; ++k) {
    await page.evaluate((own) => performance.clearMeasures(own), name);
    await act(k);
    await page.waitForFunction((own) => performance.getEntriesByName(own).length > 0, name, { polling: 5 });
    times.push(await page.evaluate((own) => performance.getEntriesByName(own)[0]?.duration ?? NaN, name));
    await page.waitForTimeout(30);
  }
  return times.sort((a, b) => a - b);
}

const part = (times: number[], p: number): number => times[Math.min(times.length - 1, Math.floor(p * times.length))] ?? NaN;

async function timeToOpen(address: string): Promise<number> {
  const begun = performance.now();
  const { page, context } = await open(browser, address);
  await page.waitForFunction(() => performance.getEntriesByName("clearloci-loci").length > 0, undefined, { polling: 5 });
  const taken = performance.now() - begun;
  await context.close();
  return taken;
}

const served = await Served.start("five_bar.yaml");
const browser = await launch();
const openings: number[] = [];
for (let k = 0; k < 5; ++k) openings.push(await timeToOpen(served.address));
openings.sort((a, b) => a - b);

const { page } = await open(browser, served.address);
await rest(page);
const slide = (k: number): Promise<void> =>
  page.evaluate((value) => {
    const slider = document.querySelector<HTMLInputElement>('input[data-id="parameters/L"]');
    if (!slider) return;
    slider.value = String(value);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, 0.45 + 0.1 * Math.abs(Math.sin(k / 7)));
const step = async (k: number): Promise<void> => {
  await page.locator(".stage").first().focus();
  await page.keyboard.press(k % 2 === 0 ? "ArrowRight" : "ArrowLeft");
};

// The zones are traced beside the loci while one slides; they can be switched off.
const withZones = await measure(page, "clearloci-loci", slide);
await rest(page);
await page.getByText("What counts").click();
await page.getByLabel("zones").uncheck();
await rest(page);
const loci = await measure(page, "clearloci-loci", slide);
await rest(page);
const pose = await measure(page, "clearloci-pose", step);

const row = (words: string, times: number[], aim: number): void =>
  console.log(`${words.padEnd(44)} median ${part(times, 0.5).toFixed(1)}, p95 ${part(times, 0.95).toFixed(1)} (aim ${aim})`);
console.log("5R, headless Chromium, from the event to the frame after the drawing, in ms");
row("slider to loci, zones traced too", withZones, aims.loci);
row("slider to loci, without zones", loci, aims.loci);
row("end effector to pose", pose, aims.pose);
row("address to first loci", openings, aims.open);
await browser.close();
served.stop();
