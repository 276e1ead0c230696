// The stills of the README: node tools/run.mjs browser/stills.ts OUT.png, with CLEARLOCI_PROGRAM set. One row: the end
// effector is dragged across a locus, a slider moves, a task is verified.
import { montage, Stills } from "./montage";
import { drag, launch, open, pose, rest, Served, type } from "./program";

const served = await Served.start("five_bar.yaml");
const browser = await launch();
const { page } = await open(browser, served.address, { width: 900, height: 620 });
await rest(page);

const stills = new Stills(page, ".stage");

await drag(page, await pose(page), [0.76, -0.1]);
await drag(page, await pose(page), [0.76, -0.01], false); // just across: the flash is at its brightest
await stills.take("Drag the end effector: a locus that it crosses flashes");
await page.mouse.up();
await drag(page, await pose(page), [0.25, -0.62]);
await page.getByRole("button", { name: "Keep to compare" }).click();
await type(page, "L", "23/50");
await stills.take("Change a length: loci and zones change; faint: the kept design");
await page.getByRole("button", { name: "Undo" }).click();
await page.getByRole("button", { name: "Drop the kept design" }).click();
await page.getByText("Task", { exact: true }).click();
await page.getByRole("button", { name: "box", exact: true }).click();
await rest(page);
await stills.take("Draw a task: it is verified while you move it");

await montage(browser, stills, process.argv[3] ?? "stills.png");
await browser.close();
served.stop();
