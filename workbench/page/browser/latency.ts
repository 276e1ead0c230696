// From the move of a slider to the painted loci of the 5R, first carried over and then proven, of the end effector to the
// painted pose, and until the page is open: node tools/run.mjs browser/latency.ts, with CLEARLOCI_PROGRAM set. A move is made when the one before is painted
// and the page rests; times are the page's own marks, from the event to the frame after the drawing.
import type { Page } from "playwright-core";
import { launch, open, rest, Served } from "./program";

const moves = Number(process.env["CLEARLOCI_MOVES"] ?? 100);
/** What docs/guide/workbench.md promises, in ms. */
const aims = { carried: 33, loci: 50, pose: 33, work: 8, open: 1000 };

/**
 * Durations of the marks that `act` leaves, the first of each name a move, smallest first; a move is over when there is
 * one of the name `last`.
 */
async function measure(page: Page, last: string, act: (k: number) => Promise<void>): Promise<Map<string, number[]>> {
  const times = new Map<string, number[]>();
  for (let k = 0; k < moves; ++k) {
    await page.evaluate(() => performance.clearMeasures());
    await act(k);
    await page.waitForFunction((own) => performance.getEntriesByName(own).length > 0, last, { polling: 5 });
    const marks = await page.evaluate(() => performance.getEntriesByType("measure").map(({ name, duration }) => ({ name, duration })));
    const seen = new Set<string>();
    for (const { name, duration } of marks) {
      if (!seen.has(name)) times.set(name, [...(times.get(name) ?? []), duration]);
      seen.add(name);
    }
    await page.waitForTimeout(30);
  }
  for (const list of times.values()) list.sort((a, b) => a - b);
  return times;
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

const row = (words: string, times: number[] | undefined, aim: number): void => {
  if (times) console.log(`${words.padEnd(52)} median ${part(times, 0.5).toFixed(1)}, p95 ${part(times, 0.95).toFixed(1)} (aim ${aim}), of ${times.length}`);
};
console.log("5R, headless Chromium, from the event to the frame after the drawing, in ms");
for (const [words, times] of [["zones traced too", withZones], ["without zones", loci]] as const) {
  row(`slider to carried loci, ${words}`, times.get("clearloci-carried"), aims.carried);
  row("  of this the server's work", times.get("clearloci-carried-server"), aims.work);
  row("  of this the page's drawing", times.get("clearloci-drawing"), aims.work);
  row(`slider to proven loci, ${words}`, times.get("clearloci-loci"), aims.loci);
  row("  of this the server's work", times.get("clearloci-loci-server"), aims.loci);
}
row("end effector to pose", pose.get("clearloci-pose"), aims.pose);
row("address to first loci", openings, aims.open);
await browser.close();
served.stop();
