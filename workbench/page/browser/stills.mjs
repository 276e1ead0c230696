// The stills of the README: node stills.mjs OUT.png, with CLEARLOCI_PROGRAM set. One row: the end effector is dragged
// across a locus, a slider moves, a task is verified.
import { spawn } from "node:child_process";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const root = join(dirname(fileURLToPath(import.meta.url)), "..", "..", "..");
const flags = ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking"];
const program = spawn(process.env.CLEARLOCI_PROGRAM, ["view", join(root, "examples", "five_bar.yaml")]);
const address = await new Promise((resolve) => program.stdout.on("data", (bytes) => {
  const found = /http:\S+/.exec(String(bytes));
  if (found) resolve(found[0]);
}));
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: flags });
const page = await browser.newPage({ viewport: { width: 1000, height: 660 } });
await page.addInitScript(() => localStorage.setItem("clearloci-welcomed", "1"));
await page.goto(address);
const rest = () => page.waitForFunction(() => document.documentElement.dataset.busy === "false");
await rest();

const onPage = (at) => page.evaluate(([x, y]) => {
  const stage = document.querySelector(".stage");
  const view = JSON.parse(stage.dataset.view);
  const box = stage.getBoundingClientRect();
  return [box.left + view.origin[0] + x * view.scale[0], box.top + view.origin[1] - y * view.scale[1]];
}, at);
const drag = async (from, to, up = true) => {
  await page.mouse.move(...(await onPage(from)));
  await page.mouse.down();
  await page.mouse.move(...(await onPage(to)), { steps: 8 });
  if (up) await page.mouse.up();
};
const pose = async () => Promise.all(["x", "y"].map(async (name) => Number(await page.locator(`input.exact[aria-label="${name} of the pose"]`).inputValue())));

const stills = [];
const still = async (words) => stills.push({ words, image: (await page.locator(".stage").first().screenshot()).toString("base64") });

await drag(await pose(), [0.75, -0.06]);
await rest();
await drag(await pose(), [0.78, 0.02], false);
await page.waitForTimeout(160);
await still("Drag the end effector: crossing a locus says what lets go");
await page.mouse.up();
await drag(await pose(), [0.25, -0.6]);
await page.getByLabel("L, exact", { exact: true }).fill("7/20");
await page.getByLabel("L, exact", { exact: true }).press("Enter");
await rest();
await page.getByRole("button", { name: "Undo" }).click();
await rest();
await page.getByRole("button", { name: "Keep to compare" }).click();
await page.getByLabel("L, exact", { exact: true }).fill("23/50");
await page.getByLabel("L, exact", { exact: true }).press("Enter");
await rest();
await still("Change a length: zones follow, the kept design stays faint");
await page.getByRole("button", { name: "Drop the kept design" }).click();
await page.getByText("Task", { exact: true }).click();
await page.getByRole("button", { name: "box", exact: true }).click();
await rest();
await still("Draw a task: proven free of loci while it moves");

const sheet = await browser.newPage({ viewport: { width: 1500, height: 420 } });
await sheet.setContent(`<style>body{margin:0;display:flex;gap:10px;font:15px system-ui,sans-serif}figure{margin:0;flex:1}img{width:100%;border:1px solid #d5dae0}figcaption{padding:4px 2px}</style>
${stills.map((one) => `<figure><img src="data:image/png;base64,${one.image}"><figcaption>${one.words}</figcaption></figure>`).join("")}`);
await sheet.locator("body").screenshot({ path: process.argv[2] });
await browser.close();
program.kill();
