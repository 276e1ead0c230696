// The stills of docs/tutorial/tutorial.md, Draw it instead: node tools/run.mjs browser/drawing_stills.ts OUT.png, with
// CLEARLOCI_PROGRAM set. The label press from nothing: half drawn, driven and loaded, with its workspace and a task.
import { montage, Stills } from "./montage";
import { launch, open, rest, Served } from "./program";
import { Sheet } from "./sheet";

const served = await Served.start("");
const browser = await launch();
const { page, faults } = await open(browser, served.address, { width: 1000, height: 640 });
await page.locator("#new-sheet").click();
await rest(page);
const sheet = new Sheet(page);

const stills = new Stills(page, ".stage-column");

await sheet.take("ground");
await sheet.click([0, 0], [120, 0]);
await page.getByRole("button", { name: "Lengths", exact: true }).click();
await sheet.take("link");
await sheet.drag([0, 0], [-94, 117]);
await sheet.drag([-94, 117], [60, 245]);
await stills.takeAtRest("Pins and links, with round lengths: one line says what is missing, where");
await sheet.drag([120, 0], [214, 117]);
await sheet.drag([214, 117], [60, 245]);
await sheet.take("motor");
await sheet.click([0, 0], [120, 0]);
await sheet.take("force");
await sheet.drag([60, 245], [47, 270]);
await stills.takeAtRest("Two motors and a force: loci over the angles of the motors");
await sheet.take("workspace");
await sheet.drag([-150, 50], [270, 340]);
await page.keyboard.press("0");
await stills.takeAtRest("A workspace box: loci and zones over the place of the stamp");
console.log(faults.join("\n") || "no faults");
await montage(browser, stills, process.argv[3] ?? "drawing.png");
await browser.close();
served.stop();
