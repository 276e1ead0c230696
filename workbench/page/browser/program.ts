// The program and a browser, as a user has them: for tests, for measuring (latency.ts) and for pictures (stills.ts).
import { spawn, type ChildProcess } from "node:child_process";
import { mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium, type Browser, type BrowserContext, type Locator, type Page } from "playwright-core";

/** The folder of this file; of a script, which is bundled elsewhere, its own. */
export const here = process.env["CLEARLOCI_BROWSER_DIR"] ?? dirname(fileURLToPath(import.meta.url));
export const source = process.env["CLEARLOCI_SOURCE_DIR"] ?? join(here, "..", "..", "..");
export const program = process.env["CLEARLOCI_PROGRAM"] ?? join(source, "build", "release", "cli", "clearloci");
/** Where screenshots go, to be looked at. */
export const shots = process.env["CLEARLOCI_SHOTS"] ?? join(here, "..", "dist", "shots");

/** WebGL by software; nothing that Chromium does in the background on its own. */
const flags = [
  "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic", "--force-color-profile=srgb",
];

export async function launch(): Promise<Browser> {
  return chromium.launch({ executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium", args: flags });
}

export class Served {
  private constructor(private readonly child: ChildProcess, readonly address: string) {}

  /** `model`: an example; "": none, and the page shows its gallery. */
  static async start(model: string, ...options: string[]): Promise<Served> {
    const child = spawn(program, ["view", ...(model === "" ? [] : [join(source, "examples", model)]), ...options]);
    const address = await new Promise<string>((resolve, reject) => {
      let said = "";
      child.stdout.on("data", (bytes: Buffer) => {
        said += bytes.toString();
        const found = /http:\S+/.exec(said);
        if (found) resolve(found[0]);
      });
      child.stderr.on("data", (bytes: Buffer) => (said += bytes.toString()));
      child.on("exit", () => reject(new Error(`clearloci view ended: ${said}`)));
      child.on("error", reject);
    });
    return new Served(child, address);
  }

  stop(): void {
    this.child.removeAllListeners("exit");
    this.child.kill();
  }
}

export interface Opened {
  page: Page;
  context: BrowserContext;
  /** What went wrong in the page, and what it asked of anyone else. */
  faults: string[];
}

export async function open(browser: Browser, address: string, options: { width?: number; height?: number; dark?: boolean; first?: boolean; reduced?: boolean } = {}): Promise<Opened> {
  const context = await browser.newContext({
    viewport: { width: options.width ?? 1280, height: options.height ?? 800 },
    colorScheme: options.dark ? "dark" : "light",
    acceptDownloads: true,
  });
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  if (!options.first) await context.addInitScript(() => localStorage.setItem("clearloci-welcomed", "1"));
  await useBundle(context);
  const page = await context.newPage();
  const faults: string[] = [];
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("console", (message) => {
    // Chromium notes answers of 4xx; they are the page's to show.
    if (message.type() === "error" && !message.text().startsWith("Failed to load resource")) faults.push(message.text());
  });
  const own = new URL(address).origin;
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(own) && !url.startsWith("data:") && !url.startsWith("blob:") && !url.startsWith("file:")) faults.push(`asked ${url}`);
  });
  page.setDefaultTimeout(90_000);
  await page.goto(address, { timeout: 90_000 });
  return { page, context, faults };
}

/** While the page is worked on: a bundle of tools/bundle.mjs in the folder CLEARLOCI_PAGE takes the place of the one in the program. */
async function useBundle(context: BrowserContext): Promise<void> {
  const folder = process.env["CLEARLOCI_PAGE"];
  if (folder === undefined) return;
  for (const [name, contentType] of [["app.js", "text/javascript"], ["app.css", "text/css"]] as const)
    await context.route(`**/${name}`, (route) => route.fulfill({ path: join(folder, name), contentType }));
}

/** Until nothing has been asked or painted for a while. */
export async function rest(page: Page): Promise<void> {
  await page.waitForFunction(() => document.documentElement.dataset["busy"] === "false", undefined, { timeout: 100_000 });
}

export async function shot(page: Page, name: string): Promise<void> {
  mkdirSync(shots, { recursive: true });
  await page.screenshot({ path: join(shots, `${name}.png`) });
}

/** Where a place of the plane stands on the page: the picture says how it is scaled. */
export async function onPage(page: Page, at: readonly number[]): Promise<[number, number]> {
  return page.evaluate(([x = 0, y = 0]) => {
    const stage = document.querySelector<HTMLElement>(".stage");
    const view = JSON.parse(stage?.dataset["view"] ?? "null") as { scale: [number, number]; origin: [number, number] };
    const box = stage?.getBoundingClientRect();
    return [(box?.left ?? 0) + view.origin[0] + x * view.scale[0], (box?.top ?? 0) + view.origin[1] - y * view.scale[1]];
  }, at as number[]);
}

/** From one place of the plane to another; the hand stays on it where it is not to let go. */
export async function drag(page: Page, from: readonly number[], to: readonly number[], letGo = true): Promise<void> {
  await page.mouse.move(...(await onPage(page, from)));
  await page.mouse.down();
  await page.mouse.move(...(await onPage(page, to)), { steps: 6 });
  if (!letGo) return;
  await page.mouse.up();
  await rest(page);
}

export const exact = (page: Page, name: string): Locator => page.getByLabel(`${name}, exact`, { exact: true });

export async function type(page: Page, name: string, value: string): Promise<void> {
  await exact(page, name).fill(value);
  await exact(page, name).press("Enter");
  await rest(page);
}

/** The pose of a mechanism over x and y. */
export async function pose(page: Page): Promise<number[]> {
  return Promise.all(["x", "y"].map(async (name) => Number(await page.locator(`input.exact[aria-label="${name} of the pose"]`).inputValue())));
}
