// The stills of cad-sketch.md: node tools/run.mjs browser/sketch_stills.ts OUT.png, with CLEARLOCI_PROGRAM set. The
// label press as a CAD sketch: opened, given its workspace and its load, and a task proven.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { montage, Stills } from "./montage";
import { launch, open, rest, Served, source } from "./program";
import { Sheet } from "./sheet";

const served = await Served.start("");
const browser = await launch();
const { page, faults } = await open(browser, served.address, { width: 1000, height: 640 });
const sheet = new Sheet(page);

const stills = new Stills(page, ".stage-column");

await page.locator("#open-file").setInputFiles({ name: "press.dxf", mimeType: "image/vnd.dxf", buffer: readFileSync(join(source, "examples", "sketches", "press.dxf")) });
await page.locator("h1", { hasText: "DXF" }).waitFor();
await rest(page);
await page.locator(".said").getByRole("button", { name: "Close" }).click();
await sheet.press("Draw");
await stills.takeAtRest("The sketch, opened: layers are links, circles are pins, the layer motor drives");
await sheet.take("workspace");
await sheet.drag([-150, 50], [270, 340]);
await page.keyboard.press("0");
await stills.takeAtRest("A workspace box: loci and zones over the place of the stamp");
await page.getByText("Task", { exact: true }).click();
await sheet.press("box");
const verdict = page.locator(".verdict");
await verdict.filter({ hasText: /Verified|Refuted/ }).waitFor();
if ((await verdict.textContent())?.includes("Refuted")) {
  await sheet.press("Fit nearest");
  await verdict.filter({ hasText: "Verified" }).waitFor();
}
await rest(page);
await stills.takeAtRest(`A task: ${(await verdict.textContent())?.split(/[.:]/)[0]?.toLowerCase() ?? ""}`);
console.log(faults.join("\n") || "no faults");
await montage(browser, stills, process.argv[3] ?? "sketch.png");
await browser.close();
served.stop();
