// A slider for every free effort, with the efforts that keep every joint loaded at the pose drawn on it.
import type { FeasibleEfforts, Vanishing } from "../data/answers";
import { reactionName } from "../data/answers";
import { parseExact, roundText, shortNumber, toNumber } from "../data/exact";
import type { FreeEffort } from "../data/model_text";
import { h, replace, section } from "./dom";
import { roundAbove, type Panel } from "./panels";
import type { Workbench } from "./workbench";

/** What a slider covers: what the motor can exert, or well beyond every effort at which a joint is lost. */
export function effortSpan(own: FreeEffort, value: number, feasible: FeasibleEfforts | undefined, perUnit: number): [number, number] {
  if (own.within) return [own.within[0], own.within[1]];
  const ends = (feasible?.ranges ?? []).flatMap(({ from, to }) => [from, to]).filter((end) => end !== null);
  const most = roundAbove(1.5 * Math.max(1, Math.abs(value), ...ends.map((end) => Math.abs(end * perUnit))));
  return [-most, most];
}

/** Feasible efforts as parts of a span from 0 to 1, and what ends each. */
export function feasibleParts(feasible: FeasibleEfforts, [low, high]: readonly [number, number], perUnit: number): { from: number; to: number; words: string }[] {
  const part = (end: number | null, open: number): number => Math.min(1, Math.max(0, ((end === null ? open : end * perUnit) - low) / (high - low)));
  const lost = (names: Vanishing[]): string => names.map(reactionName).join(", ");
  return feasible.ranges
    .map(({ from, to, below, above }) => {
      const ends = [from !== null ? `from ${shortNumber(from * perUnit)}${below.length > 0 ? ` (${lost(below)})` : ""}` : "", to !== null ? `to ${shortNumber(to * perUnit)}${above.length > 0 ? ` (${lost(above)})` : ""}` : ""];
      return { from: part(from, low), to: part(to, high), words: `feasible ${ends.filter(Boolean).join(" ")}`.trim() };
    })
    .filter(({ from, to }) => to > from);
}

export function preloadPanel(bench: Workbench): Panel {
  const body = h("div", {});
  const element = section("Preload", true, body, h("p", { class: "quiet" }, "Green: efforts that keep every joint loaded at the pose. At an end the named reaction vanishes, or is as small as the task allows."));
  const rows = new Map<string, { slider: HTMLInputElement; text: HTMLInputElement; track: HTMLElement }>();
  let built = "";

  const row = ({ joint, unit }: FreeEffort): HTMLElement => {
    const track = h("div", { class: "effort-track", "data-joint": joint });
    const slider = h("input", { type: "range", step: "any", "aria-label": `effort of ${joint}` });
    const text = h("input", { type: "text", class: "exact", "aria-label": `effort of ${joint}, exact`, autocomplete: "off" });
    const set = (value: string, gesture?: string): void => bench.change({ preload: { ...bench.state.preload, [joint]: value } }, gesture);
    slider.addEventListener("input", () => set(roundText(Number(slider.value), (Number(slider.max) - Number(slider.min)) / 400), `preload-${joint}`));
    slider.addEventListener("change", () => bench.history.endGesture());
    text.addEventListener("change", () => (parseExact(text.value) ? set(text.value.trim()) : update()));
    rows.set(joint, { slider, text, track });
    return h("div", { class: "value-row" }, h("label", {}, h("span", { class: "value-name" }, joint), h("span", { class: "effort" }, track, slider)), text, h("span", { class: "unit" }, unit));
  };

  const update = (): void => {
    const { efforts } = bench;
    element.hidden = efforts.length === 0;
    const signature = JSON.stringify(efforts.map(({ joint, unit }) => [joint, unit]));
    if (signature !== built) {
      rows.clear();
      replace(body, ...efforts.map(row));
    }
    built = signature;
    for (const own of efforts) {
      const entry = rows.get(own.joint);
      if (!entry) continue;
      const feasible = bench.poseFault ? undefined : bench.pose?.feasible_efforts?.[own.joint];
      const perUnit = 1 / bench.units.force.size;
      const exact = parseExact(own.value);
      const value = exact ? toNumber(exact) : 0;
      const held = document.activeElement === entry.slider && entry.slider.max !== "";
      const span: [number, number] = held && !own.within ? [Number(entry.slider.min), Number(entry.slider.max)] : effortSpan(own, value, feasible, perUnit);
      [entry.slider.min, entry.slider.max] = [String(span[0]), String(span[1])];
      entry.slider.value = String(value);
      if (document.activeElement !== entry.text) entry.text.value = own.value;
      replace(
        entry.track,
        ...(feasible ? feasibleParts(feasible, span, perUnit) : []).map(({ from, to, words }) => {
          const part = h("span", { class: "feasible", title: words });
          part.style.left = `${100 * from}%`;
          part.style.width = `${100 * (to - from)}%`;
          return part;
        }),
      );
    }
  };
  return { element, update: (news) => (news.has("pose") || news.has("model") || news.has("state")) && update() };
}
