// The 5R on the page, as a designer uses it.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { describe, expect, it } from "vitest";
import { drag, exact, onPage, pose, rest, shot, source, type } from "./program";
import { difference, session } from "./session";

const start = session("five_bar.yaml");

describe("the page", () => {
  it("explains itself to a first visitor, and once", async () => {
    const page = await start({ first: true });
    const dialog = page.getByRole("dialog");
    await expect.poll(() => dialog.isVisible()).toBe(true);
    expect(await dialog.textContent()).toContain("the pin crosses its clearance");
    await shot(page, "first-visit");
    await page.getByRole("button", { name: "Start designing" }).click();
    await page.reload();
    await rest(page);
    expect(await dialog.isVisible()).toBe(false);
  });

  it("looks like its reference", async () => {
    const page = await start();
    await shot(page, "wide");
    expect(difference(await page.locator(".stage:not(.space)").screenshot(), "five_bar")).toBeLessThan(0.02);
  });

  it("fits a narrow window and a dark one", async () => {
    const page = await start({ width: 390, height: 844, dark: true });
    await shot(page, "narrow-dark");
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(wide).toBeLessThanOrEqual(390);
    expect(await page.evaluate(() => document.documentElement.dataset["theme"])).toBe("dark");
  });
});

describe("the hand", () => {
  it("drags the end effector, and undoes it in one step", async () => {
    const page = await start();
    const before = await pose(page);
    await drag(page, before, [0.3, -0.5]);
    const after = await pose(page);
    expect(after[0]).toBeCloseTo(0.3, 2);
    expect(after[1]).toBeCloseTo(-0.5, 2);
    expect(await page.locator('[data-fact="pose error"]').textContent()).toMatch(/dx .*m, dy/);
    await page.keyboard.press("Control+z");
    await rest(page);
    expect(await pose(page)).toEqual(before);
    await page.keyboard.press("Control+Shift+z");
    await rest(page);
    expect(await pose(page)).toEqual(after);
  });

  it("keeps the last posture where a pose is out of reach, and says so", async () => {
    const page = await start();
    await drag(page, (await pose(page)), [-0.45, 0.9]);
    expect(await page.locator(".notice").textContent()).toContain("out of reach: B1 cannot be placed");
    expect(await page.getByRole("alert").getByText("out of reach").textContent()).toContain("cannot be placed");
  });

  it("tells what vanishes on a locus that it crosses", async () => {
    const page = await start();
    await drag(page, await pose(page), [0.4, -0.3]);
    const stage = page.locator(".stage:not(.space)");
    expect(await stage.getAttribute("data-crossed")).toContain("direct singularity");
  });

  it("drags a joint on the ground", async () => {
    const page = await start();
    await drag(page, [0.5, 0], [0.62, 0.05]);
    expect(Number(await exact(page, "d").inputValue())).toBeCloseTo(0.62, 2);
    expect(await page.locator(".notice.fault").count()).toBe(0);
  });

  it("moves a slider, and the curves follow", async () => {
    const page = await start();
    const before = await page.locator(".stage:not(.space)").screenshot();
    await page.getByLabel("L", { exact: true }).fill("0.4");
    await rest(page);
    expect(await exact(page, "L").inputValue()).toBe("0.4");
    expect(Buffer.compare(before, await page.locator(".stage:not(.space)").screenshot())).not.toBe(0);
  });

  it("shows no posture of another design", async () => {
    const page = await start();
    await type(page, "L", "0.233");
    expect(await page.locator(".notice").textContent()).toContain("out of reach");
    expect(await page.locator('[data-fact="pose error"]').count()).toBe(0);
    await type(page, "L", "0.5");
    expect(await page.locator('[data-fact="pose error"]').count()).toBe(1);
  });

  it("names curves by the numbers of the present design", async () => {
    const page = await start();
    const legend = page.locator(".legend");
    const ids = async (): Promise<string[]> => [...((await legend.textContent()) ?? "").matchAll(/c\d+/g)].map(([id]) => id);
    expect(await ids()).toContain("c10");
    await type(page, "force at P, x", "-24");
    expect(await ids()).not.toContain("c10");
  });

  it("says how large take-up is drawn in the present view", async () => {
    const page = await start();
    const fact = page.locator('[data-fact="take-up drawn"]');
    const times = async (): Promise<number> => Number(((await fact.textContent()) ?? "").replace(/[^0-9]/g, ""));
    await expect.poll(times).toBe(1000);
    await page.locator(".stage:not(.space)").focus();
    for (let k = 0; k < 12; ++k) await page.keyboard.press("+");
    await expect.poll(times).toBeLessThan(1000);
  });

  it("works from the keyboard alone", async () => {
    const page = await start();
    const before = await pose(page);
    await page.locator(".stage:not(.space)").focus();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Shift+ArrowUp");
    await rest(page);
    const after = await pose(page);
    expect((after[0] ?? 0) - (before[0] ?? 0)).toBeCloseTo(0.015, 6);
    expect((after[1] ?? 0) - (before[1] ?? 0)).toBeCloseTo(0.002, 6);
    await page.keyboard.press("+");
    await page.keyboard.press("0");
  });
});

interface Seen {
  loci: string;
  legend: string;
  ink: number;
}

/** What is seen with each answer while a slider moves, with a proof that takes a while: the legend's words, and how many pixels have the strong colours of curves. */
async function seenWhile(page: Page, move: () => Promise<void>): Promise<Seen[]> {
  await page.evaluate(() => {
    const fetched = window.fetch.bind(window);
    window.fetch = async (...question) => {
      const answer = await fetched(...question);
      if (question[0] !== "api/loci") return answer;
      const lines = (await answer.text()).split("\n");
      const slow = new ReadableStream({
        async start(stream): Promise<void> {
          for (const [k, line] of lines.entries()) {
            if (k > 0) await new Promise((then) => setTimeout(then, 300));
            stream.enqueue(new TextEncoder().encode(line + (k + 1 < lines.length ? "\n" : "")));
          }
          stream.close();
        },
      });
      return new Response(slow, { status: answer.status, headers: answer.headers });
    };
    const seen: Seen[] = ((window as unknown as { seen: Seen[] }).seen = []);
    const look = (): void => {
      const canvas = document.querySelector<HTMLCanvasElement>('canvas[data-layer="loci"]');
      const pixels = canvas?.getContext("2d")?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
      let ink = 0;
      const loci = document.documentElement.dataset["loci"] ?? "";
      if (seen.at(-1)?.loci === loci) return; // said once more
      for (let k = 0; k < pixels.length; k += 4) {
        const red = pixels[k] ?? 0, green = pixels[k + 1] ?? 0, blue = pixels[k + 2] ?? 0, alpha = pixels[k + 3] ?? 0;
        if (alpha > 128 && Math.max(red, green, blue) - Math.min(red, green, blue) > 60) ++ink;
      }
      seen.push({ loci, legend: document.querySelector(".proof")?.textContent ?? "", ink });
    };
    new MutationObserver(look).observe(document.documentElement, { attributeFilter: ["data-loci"] });
  });
  await move();
  await rest(page);
  return page.evaluate(() => (window as unknown as { seen: Seen[] }).seen);
}

describe("two answers a move", () => {
  it("come: loci carried over that look unproven, then the proof", async () => {
    const page = await start();
    await page.getByText("What counts").click();
    await page.getByLabel("zones").uncheck();
    await rest(page);
    expect(await page.locator(".proof").textContent()).toBe("Proven");
    const seen = await seenWhile(page, () => page.getByLabel("L", { exact: true }).fill("0.48"));
    expect(seen.map((one) => one.loci)).toEqual(["proven", "carried", "proven"]);
    expect(seen[1]?.legend).toContain("Not yet proven");
    expect(seen[2]?.legend).toBe("Proven");
    // The same curves, in short dashes and lighter.
    expect(seen[1]?.ink).toBeLessThan(0.7 * (seen[2]?.ink ?? 0));
    expect(await exact(page, "L").inputValue()).toBe("0.48");
  });

  it("are taken back where the next design does not close", async () => {
    const page = await start();
    await type(page, "d", "0.5");
    await type(page, "L", "0.1");
    expect(await page.evaluate(() => document.documentElement.dataset["loci"])).toBe("proven");
    expect(await page.locator(".proof").textContent()).toBe("Proven");
  });
});

describe("values", () => {
  it("are typed exactly, and stand in the address and in the file", async () => {
    const page = await start();
    await type(page, "L", "7/20");
    await expect.poll(() => page.url()).toContain("#");
    const link = page.url();
    const waiting = page.waitForEvent("download");
    await page.locator("summary", { hasText: "Download" }).click();
    await page.locator("#download-model").click();
    const file = readFileSync(await (await waiting).path(), "utf8");
    const original = readFileSync(join(source, "examples", "five_bar.yaml"), "utf8");
    expect(file).toBe(original.replace("L: 0.5 ", "L: 7/20 "));

    const again = await start({}, link);
    expect(await exact(again, "L").inputValue()).toBe("7/20");
  });

  it("that are wrong are refused beside their field, and the last good picture stays", async () => {
    const page = await start();
    const stage = page.locator('canvas[data-layer="loci"]');
    const before = await stage.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
    await type(page, "L", "0,5");
    const said = page.locator('[id="fault-parameters/L"]');
    await expect.poll(() => said.textContent()).toMatch(/^five_bar\.yaml:\d+:\d+: /);
    expect(await exact(page, "L").getAttribute("aria-invalid")).toBe("true");
    expect(await page.locator(".notice").textContent()).toContain("last design that works");
    expect(await stage.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL())).toBe(before);
    await shot(page, "wrong-value");
    await type(page, "L", "0.5");
    await expect.poll(() => said.textContent()).toBe("");
  });

  it("that cannot close say so beside their field, and the last good picture stays", async () => {
    const page = await start();
    await type(page, "d", "0.5");
    const stage = page.locator('canvas[data-layer="loci"]');
    const before = await stage.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
    await type(page, "L", "0.1");
    expect(await page.locator('[id="fault-parameters/L"]').textContent()).toContain("does not close");
    expect(await page.locator(".notice").textContent()).toContain("last design that works");
    expect(await stage.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL())).toBe(before);
    await page.getByRole("button", { name: "Undo" }).click();
    await rest(page);
    expect(await page.locator(".notice.fault").count()).toBe(0);
  });
});

describe("curves", () => {
  it("say what vanishes, why, their degree and formula", async () => {
    const page = await start();
    // On the circle of radius 1/2 about (0, 1/2), on which B1P is parallel to the load.
    const [x, y] = await onPage(page, [0.4, 0.2]);
    await page.mouse.move(x, y);
    const reading = page.locator(".curve-reading");
    await expect.poll(() => reading.textContent()).toContain("f_B2");
    expect(await reading.textContent()).toMatch(/link B1P parallel to the load.*degree 2.*x\^2 \+ y\^2 - y/s);
    await shot(page, "hover");
  });

  it("are switched off and on", async () => {
    const page = await start();
    const stage = page.locator('canvas[data-layer="loci"]');
    const before = await stage.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
    const box = page.locator(".legend-row input").first();
    await box.uncheck();
    await rest(page);
    expect(await stage.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL())).not.toBe(before);
    await box.check();
    await rest(page);
    expect(await stage.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL())).toBe(before);
  });

  it("of a working mode are chosen by its picture", async () => {
    const page = await start();
    const modes = page.getByRole("radio");
    await expect.poll(() => modes.count()).toBe(4);
    await modes.nth(1).click();
    await rest(page);
    expect(await modes.nth(1).getAttribute("aria-checked")).toBe("true");
  });

  it("of a kept design stay to compare", async () => {
    const page = await start();
    await page.getByRole("button", { name: "Keep to compare" }).click();
    await type(page, "L", "0.6");
    await shot(page, "kept");
    await page.getByRole("button", { name: "Drop the kept design" }).click();
    await rest(page);
  });
});

describe("a task", () => {
  it("is drawn, verified, dragged to where it fails, and fitted", async () => {
    const page = await start();
    await page.getByText("Task", { exact: true }).click();
    await page.getByRole("button", { name: "box", exact: true }).click();
    const verdict = page.locator(".verdict");
    await expect.poll(() => verdict.textContent()).toContain("Verified");
    expect(await verdict.textContent()).toMatch(/Margin at least [\d.]+ m/);
    await shot(page, "task-verified");
    const [x, y] = await pose(page);
    await drag(page, [(x ?? 0) + 0.06, (y ?? 0) + 0.06], [(x ?? 0) + 0.06, -0.38]);
    await expect.poll(() => verdict.textContent()).toContain("Refuted");
    await shot(page, "task-refuted");
    await page.getByRole("button", { name: "Fit nearest" }).click();
    await expect.poll(() => verdict.textContent(), { timeout: 30_000 }).toContain("Verified");
    // A tolerance it does not bear: the witness is a pose and a design.
    await page.getByLabel("tolerances", { exact: true }).fill("L: 0.1");
    await page.getByLabel("tolerances", { exact: true }).press("Enter");
    await expect.poll(() => verdict.textContent()).toMatch(/Refuted.*of the design L = /s);
    await page.getByRole("button", { name: "Show the witness" }).click();
    await rest(page);
    expect(await exact(page, "L").inputValue()).not.toBe("0.5");
    await page.getByLabel("margin", { exact: true }).fill("a lot");
    await page.getByLabel("margin", { exact: true }).press("Enter");
    await expect.poll(() => page.getByRole("alert").allTextContents()).toEqual(expect.arrayContaining([expect.stringContaining("task:")]));
  });
});

describe("a verdict", () => {
  it("is asked for again where a joint is switched off", async () => {
    const page = await start();
    await page.getByText("Task", { exact: true }).click();
    await page.getByRole("button", { name: "box", exact: true }).click();
    await expect.poll(() => page.locator(".verdict").textContent()).toContain("Verified");
    const asked = page.waitForRequest((request) => request.url().endsWith("/api/verify"));
    await page.locator("label", { hasText: /^A1$/ }).locator("input").first().evaluate((box: HTMLInputElement) => box.click());
    expect(((await asked).postDataJSON() as { joints: string[] }).joints).not.toContain("A1");
  });
});

describe("exports", () => {
  it("are downloaded", async () => {
    const page = await start();
    await page.locator("summary", { hasText: "Download" }).click();
    for (const [id, beginning] of [["loci-dxf", "999"], ["loci-svg", "<?xml"], ["zones-geojson", "{"]]) {
      const waiting = page.waitForEvent("download");
      await page.locator(`[data-export="${id ?? ""}"]`).click();
      const file = readFileSync(await (await waiting).path(), "utf8");
      expect(file.trimStart().startsWith(beginning ?? "") || file.includes("SECTION")).toBe(true);
    }
  });
});
