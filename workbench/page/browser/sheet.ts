// A hand on the sheet of the page: what it does is counted, as a person would count it.
import type { Page } from "playwright-core";
import { rest } from "./program";

export class Sheet {
  /** Clicks, drags and keys so far. */
  actions = 0;

  constructor(readonly page: Page) {}

  /** Where a place, in mm, stands on the page. */
  async at(place: readonly [number, number]): Promise<[number, number]> {
    return this.page.locator(".sheet").evaluate((sheet: HTMLElement, [x, y]): [number, number] => {
      const view = JSON.parse(sheet.dataset["view"] ?? "null") as { scale: [number, number]; origin: [number, number] };
      const box = sheet.getBoundingClientRect();
      return [box.left + view.origin[0] + (x / 1000) * view.scale[0], box.top + view.origin[1] - (y / 1000) * view.scale[1]];
    }, place);
  }

  async take(tool: string): Promise<void> {
    ++this.actions;
    await this.page.locator(`button[data-tool="${tool}"]`).click();
  }
  async click(...places: [number, number][]): Promise<void> {
    for (const place of places) {
      ++this.actions;
      await this.page.mouse.click(...(await this.at(place)));
    }
    await rest(this.page);
  }
  async drag(from: [number, number], to: [number, number]): Promise<void> {
    ++this.actions;
    await this.page.mouse.move(...(await this.at(from)));
    await this.page.mouse.down();
    await this.page.mouse.move(...(await this.at(to)), { steps: 5 });
    await this.page.mouse.up();
    await rest(this.page);
  }
  async press(name: string): Promise<void> {
    ++this.actions;
    await this.page.getByRole("button", { name, exact: true }).click();
    await rest(this.page);
  }
  /** What is missing or wrong, and at which element. */
  async said(): Promise<[words: string, element: string]> {
    const callout = this.page.locator(".callout");
    if (!(await callout.isVisible())) return ["", ""];
    return [(await callout.textContent()) ?? "", (await callout.getAttribute("data-element")) ?? ""];
  }
  /** The file as the page shows it. */
  async file(): Promise<string> {
    const text = this.page.locator("#file-text");
    if (!(await text.isVisible())) await this.page.locator("summary", { hasText: /^File$/ }).click();
    await this.page.waitForFunction(() => document.querySelector<HTMLTextAreaElement>("#file-text")?.value !== "");
    await rest(this.page);
    return text.inputValue();
  }
}
