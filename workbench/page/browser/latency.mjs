// From the move of a slider to the painted loci of the 5R, of the end effector to the painted pose, and until the page is
// open: node latency.mjs, with CLEARLOCI_PROGRAM set. A move is made each time the one before is painted and the page has
// rested a little; times are the page's own marks, from the event to the frame after the drawing.
import { spawn } from "node:child_process";
import { dirname, join } from "node:path";
import { performance } from "node:perf_hooks";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const root = join(dirname(fileURLToPath(import.meta.url)), "..", "..", "..");
const flags = ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const moves = 120;

const program = spawn(process.env.CLEARLOCI_PROGRAM, ["view", join(root, "examples", "five_bar.yaml")]);
const address = await new Promise((resolve) => program.stdout.on("data", (bytes) => {
  const found = /http:\S+/.exec(String(bytes));
  if (found) resolve(found[0]);
}));
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: flags });
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await page.addInitScript(() => localStorage.setItem("clearloci-welcomed", "1"));

const opening = performance.now();
await page.goto(address);
await page.waitForFunction(() => performance.getEntriesByName("clearloci-loci").length > 0);
const opened = performance.now() - opening;
const rest = () => page.waitForFunction(() => document.documentElement.dataset.busy === "false");
await rest();

/** Durations of the marks of this name that `act` leaves, one a move. */
async function measure(name, act) {
  const times = [];
  for (let k = 0; k < moves; ++k) {
    await page.evaluate((own) => performance.clearMeasures(own), name);
    await act(k);
    await page.waitForFunction((own) => performance.getEntriesByName(own).length > 0, name, { polling: 5 });
    times.push(await page.evaluate((own) => performance.getEntriesByName(own)[0].duration, name));
    await page.waitForTimeout(30);
  }
  return times.sort((a, b) => a - b);
}

const slide = (k) => page.evaluate((value) => {
  const slider = document.querySelector('input[data-id="parameters/L"]');
  slider.value = String(value);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}, 0.45 + 0.1 * Math.abs(Math.sin(k / 7)));
const move = async (k) => {
  await page.locator(".stage").first().focus();
  await page.keyboard.press(k % 2 === 0 ? "ArrowRight" : "ArrowLeft");
};

const part = (times, p) => times[Math.min(times.length - 1, Math.floor(p * times.length))].toFixed(1);
// The zones are traced beside the loci while one slides; they can be switched off.
const withZones = await measure("clearloci-loci", slide);
await rest();
await page.getByText("What counts").click();
await page.getByLabel("zones").uncheck();
await rest();
const loci = await measure("clearloci-loci", slide);
await rest();
const pose = await measure("clearloci-pose", move);
console.log("5R, headless Chromium, from the event to the frame after the drawing, in ms");
for (const [words, times, aim] of [["slider to loci", loci, "50"], ["slider to loci, zones traced too", withZones, ""], ["end effector to pose", pose, "33"]])
  console.log(`${words.padEnd(36)} median ${part(times, 0.5)}, p95 ${part(times, 0.95)}${aim && ` (aim ${aim})`}`);
console.log(`${"address to first loci".padEnd(36)} ${opened.toFixed(0)} (aim 1000)`);
await browser.close();
program.kill();
