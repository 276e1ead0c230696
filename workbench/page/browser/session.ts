// The program and a browser, as a user has them.
import { spawn, type ChildProcess } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import pixelmatch from "pixelmatch";
import { chromium, type Browser, type BrowserContext, type Page } from "playwright-core";
import { PNG } from "pngjs";
import { afterAll, afterEach, beforeAll, expect } from "vitest";

const here = dirname(fileURLToPath(import.meta.url));
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

  static async start(model: string, ...options: string[]): Promise<Served> {
    const child = spawn(program, ["view", join(source, "examples", model), ...options]);
    const address = await new Promise<string>((resolve, reject) => {
      let said = "";
      child.stdout.on("data", (bytes: Buffer) => {
        said += bytes.toString();
        const found = /http:\S+/.exec(said);
        if (found) resolve(found[0]);
      });
      child.stderr.on("data", (bytes: Buffer) => (said += bytes.toString()));
      child.on("exit", () => reject(new Error(`clearloci view ended: ${said}`)));
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

/**
 * The program and a browser, started once for the tests of a file. What comes back opens the page, at rest; what a test
 * opened is closed after it, or by what it opens next, and held to be without faults.
 */
export function session(model: string): (options?: Parameters<typeof open>[2], address?: string) => Promise<Page> {
  let browser: Browser | undefined;
  let served: Served | undefined;
  let opened: Opened | undefined;
  const close = async (): Promise<void> => {
    expect(opened?.faults ?? []).toEqual([]);
    await opened?.context.close();
    opened = undefined;
  };
  beforeAll(async () => {
    browser = await launch();
    served = await Served.start(model);
  });
  afterAll(async () => {
    await browser?.close();
    served?.stop();
  });
  afterEach(close);
  return async (options = {}, address) => {
    if (!browser || !served) throw new Error("the program and the browser are started before the first test");
    await close();
    opened = await open(browser, address ?? served.address, options);
    await rest(opened.page);
    return opened.page;
  };
}

/** Until nothing has been asked or painted for a while. */
export async function rest(page: Page): Promise<void> {
  await page.waitForFunction(() => document.documentElement.dataset["busy"] === "false", undefined, { timeout: 100_000 });
}

export async function shot(page: Page, name: string): Promise<void> {
  mkdirSync(shots, { recursive: true });
  await page.screenshot({ path: join(shots, `${name}.png`) });
}

/** The part of pixels in which a screenshot differs from its reference; CLEARLOCI_NEW_REFERENCES=1 makes that anew. */
export function difference(bytes: Buffer, name: string): number {
  const path = join(here, "references", `${name}.png`);
  if (process.env["CLEARLOCI_NEW_REFERENCES"] === "1" || !existsSync(path)) {
    if (process.env["CLEARLOCI_NEW_REFERENCES"] !== "1") throw new Error(`there is no reference ${path}`);
    writeFileSync(path, bytes);
    return 0;
  }
  const [one, other] = [PNG.sync.read(bytes), PNG.sync.read(readFileSync(path))];
  if (one.width !== other.width || one.height !== other.height) return 1;
  return pixelmatch(one.data, other.data, undefined, one.width, one.height, { threshold: 0.2 }) / (one.width * one.height);
}
