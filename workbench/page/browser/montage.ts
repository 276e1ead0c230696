// Stills side by side in one picture, each with its words below.
import type { Browser, Page } from "playwright-core";
import { rest } from "./program";

interface Still {
  words: string;
  /** In base64. */
  image: string;
}

/** Takes stills of a part of the page. */
export class Stills {
  readonly taken: Still[] = [];
  constructor(private readonly page: Page, private readonly part: string) {}

  async take(words: string): Promise<void> {
    this.taken.push({ words, image: (await this.page.locator(this.part).first().screenshot()).toString("base64") });
  }

  /** With the pointer in the corner and the page at rest. */
  async takeAtRest(words: string): Promise<void> {
    await this.page.mouse.move(5, 5);
    await rest(this.page);
    await this.take(words);
  }
}

export async function montage(browser: Browser, stills: Stills, path: string): Promise<void> {
  const page = await browser.newPage({ viewport: { width: 1320, height: 600 } });
  const figures = stills.taken.map((one) => `<figure><img src="data:image/png;base64,${one.image}"><figcaption>${one.words}</figcaption></figure>`);
  await page.setContent(`<style>body{margin:0;background:#fff}div{display:flex;gap:12px;font:14px system-ui,"DejaVu Sans",sans-serif}
figure{margin:0;flex:1}img{width:100%;border:1px solid #d5dae0}figcaption{padding:4px 2px}</style><div>${figures.join("")}</div>`);
  await page.locator("div").screenshot({ path });
  await page.close();
}
