// The program and a browser for the tests of a file, and screenshots held against their references.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import pixelmatch from "pixelmatch";
import type { Browser, Page } from "playwright-core";
import { PNG } from "pngjs";
import { afterAll, afterEach, beforeAll, expect } from "vitest";
import { here, launch, open, rest, Served, type Opened } from "./program";

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
