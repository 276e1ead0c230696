// Stills side by side in one picture, each with its words below.
import type { Browser } from "playwright-core";

export interface Still {
  words: string;
  /** In base64. */
  image: string;
}

export async function montage(browser: Browser, stills: Still[], path: string): Promise<void> {
  const page = await browser.newPage({ viewport: { width: 1320, height: 600 } });
  const figures = stills.map((one) => `<figure><img src="data:image/png;base64,${one.image}"><figcaption>${one.words}</figcaption></figure>`);
  await page.setContent(`<style>body{margin:0;background:#fff}div{display:flex;gap:12px;font:14px system-ui,"DejaVu Sans",sans-serif}
figure{margin:0;flex:1}img{width:100%;border:1px solid #d5dae0}figcaption{padding:4px 2px}</style><div>${figures.join("")}</div>`);
  await page.locator("div").screenshot({ path });
  await page.close();
}
