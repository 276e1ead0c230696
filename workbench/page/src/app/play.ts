// One coordinate goes through its range and back, or round a full turn; the reactions that vanish on the way are named.
import { h } from "./dom";
import { reactionName, type Picture, type Point } from "../data/answers";
import { shownOf } from "../draw/loci";
import { crossed } from "../draw/pick";
import { crossingWords } from "./stage_drawing";
import type { Workbench } from "./workbench";

const round = 2 * Math.PI;

/** Where a value is after some part of a cycle: round a full turn, else there and back. */
export function alongPlay(low: number, high: number, turns: boolean, part: number): number {
  const t = part - Math.floor(part);
  if (turns) return low + t * (high - low);
  return low + (t < 0.5 ? 2 * t : 2 - 2 * t) * (high - low);
}

/** What vanishes between two poses over one or two coordinates. */
export function passed(picture: Picture, from: readonly number[], to: readonly number[]): string[] {
  if (from.length === 2) {
    const way = [from, to].map((at): Point => [at[0] ?? 0, at[1] ?? 0]) as [Point, Point];
    const curves = crossed(shownOf(picture, undefined, new Set()), ...way).filter((one) => one.kind !== "workspace-boundary");
    return curves.length > 0 ? [crossingWords(curves)] : [];
  }
  if (from.length !== 1) return [];
  const [low, high] = [Math.min(from[0] ?? 0, to[0] ?? 0), Math.max(from[0] ?? 0, to[0] ?? 0)];
  const found = picture.point_groups.flatMap((group) => group.points.flatMap((index) => picture.loci.isolated_points[index] ?? []));
  const names = found.filter((one) => (one.at[0] ?? NaN) > low && (one.at[0] ?? NaN) <= high && one.kind !== "workspace-boundary").map((one) => one.vanishing.map(reactionName).join(", ") || one.kind.replace("-", " "));
  return [...new Set(names)];
}

/** `over`: how many free coordinates it is for. */
export function playBar(bench: Workbench, over: (n: number) => boolean): HTMLElement {
  const play = h("button", { type: "button", "aria-pressed": "false", title: "One coordinate goes through its range" }, "Play");
  const which = h("select", { "aria-label": "the coordinate that plays" });
  const speed = h("input", { type: "range", min: "-2", max: "2", step: "0.1", value: "0", "aria-label": "speed" });
  const said = h("span", { class: "losses", role: "status" });
  let last: number | undefined;
  let part = 0;
  let shownUntil = 0;

  const tick = (now: number): void => {
    if (last === undefined) return;
    const k = Math.max(0, which.selectedIndex);
    const range = bench.coordinates[k];
    const at = bench.state.at;
    if (!range || !at) return stop();
    const turns = range.angle && Math.abs(range.upper - range.lower - round) < 1e-9;
    part += ((now - last) / 6000) * 2 ** Number(speed.value);
    last = now;
    const before = at[k] ?? 0;
    const value = Number(alongPlay(range.lower, range.upper, turns, part).toPrecision(9));
    const to = at.map((one, i) => (i === k ? value : one));
    const names = bench.picture && Math.abs(value - before) < (range.upper - range.lower) / 2 ? passed(bench.picture, at, to) : [];
    if (names.length > 0) {
      said.textContent = `vanishes: ${names.join("; ")}`;
      shownUntil = now + 1200;
    } else if (now > shownUntil) said.textContent = "";
    bench.change({ at: to }, "play");
    requestAnimationFrame(tick);
  };
  const stop = (): void => {
    last = undefined;
    said.textContent = "";
    bench.history.endGesture();
    play.textContent = "Play";
    play.setAttribute("aria-pressed", "false");
    bench.setPlaying(false);
  };
  play.addEventListener("click", () => {
    if (last !== undefined) return stop();
    const k = Math.max(0, which.selectedIndex);
    const range = bench.coordinates[k];
    const at = bench.state.at?.[k];
    if (!range || at === undefined) return;
    const turns = range.angle && Math.abs(range.upper - range.lower - round) < 1e-9;
    part = ((at - range.lower) / (range.upper - range.lower)) * (turns ? 1 : 0.5);
    last = performance.now();
    play.textContent = "Stop";
    play.setAttribute("aria-pressed", "true");
    bench.setPlaying(true);
    requestAnimationFrame(tick);
  });
  const element = h("div", { class: "play" }, play, which, h("label", { class: "tick" }, "speed ", speed), said);
  let names = "";
  bench.watch(() => {
    element.hidden = bench.nothing || bench.missing !== undefined || !over(bench.coordinates.length);
    if (element.hidden && last !== undefined) stop();
    const now = bench.coordinates.map((one) => one.name).join();
    if (now === names) return;
    names = now;
    which.replaceChildren(...bench.coordinates.map((one) => h("option", { value: one.name }, one.name)));
    which.hidden = bench.coordinates.length === 1;
  });
  return element;
}
