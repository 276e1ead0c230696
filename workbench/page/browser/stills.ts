// The stills of the README: node tools/run.mjs browser/stills.ts OUT.png, with CLEARLOCI_PROGRAM set. One row: the end
// effector is dragged across a locus, a slider moves, a task is verified.
import { drag, launch, open, pose, rest, Served, type } from "./program";

const served = await Served.start("five_bar.yaml");
const browser = await launch();
const { page } = await open(browser, served.address, { width: 900, height: 620 });
await rest(page);

const stills: { words: string; image: string }[] = [];
const still = async (words: string): Promise<void> => {
  stills.push({ words, image: (await page.locator(".stage").first().screenshot()).toString("base64") });
};

await drag(page, await pose(page), [0.76, -0.1]);
await drag(page, await pose(page), [0.76, -0.01], false); // just across: the flash is at its brightest
await still("Drag the end effector: a crossed locus says what lets go");
await page.mouse.up();
await drag(page, await pose(page), [0.25, -0.62]);
await page.getByRole("button", { name: "Keep to compare" }).click();
await type(page, "L", "23/50");
await still("Change a length: loci and zones follow; a kept design stays");
await page.getByRole("button", { name: "Undo" }).click();
await page.getByRole("button", { name: "Drop the kept design" }).click();
await page.getByText("Task", { exact: true }).click();
await page.getByRole("button", { name: "box", exact: true }).click();
await rest(page);
await still("Draw a task: proven, with its margin, while it moves");

const sheet = await browser.newPage({ viewport: { width: 1320, height: 600 } });
const figures = stills.map((one) => `<figure><img src="data:image/png;base64,${one.image}"><figcaption>${one.words}</figcaption></figure>`);
await sheet.setContent(`<style>body{margin:0;background:#fff}div{display:flex;gap:12px;font:14px system-ui,"DejaVu Sans",sans-serif}
figure{margin:0;flex:1}img{width:100%;border:1px solid #d5dae0}figcaption{padding:4px 2px}</style><div>${figures.join("")}</div>`);
await sheet.locator("div").screenshot({ path: process.argv[3] ?? "stills.png" });
await browser.close();
served.stop();
