// A trajectory: followed, played back, its contact losses marked.
import { shortNumber } from "../data/exact";
import { smallUnit } from "../data/units";
import { h, replace, section } from "./dom";
import type { Panel } from "./panels";
import { Plot } from "./plot";
import type { Workbench } from "./workbench";

export function trajectoryPanel(bench: Workbench): Panel {
  const text = h("textarea", { spellcheck: "false", "aria-label": "Trajectory file", placeholder: "format: 1\npath: …" });
  const fault = h("div", { class: "fault", role: "alert" });
  const open = h("input", { type: "file", accept: ".yaml,.yml", "aria-label": "Open a trajectory file" });
  const losses = h("ul", {});
  const play = h("button", { type: "button" }, "Play");
  const time = h("input", { type: "range", min: 0, max: 1, step: "any", value: 0, "aria-label": "Time" });
  const clock = h("span", { class: "quiet" });
  const player = h("div", { class: "player" }, play, time, clock);
  const errors = new Plot("Error along the trajectory");
  const element = section("Trajectory", false, h("p", { class: "quiet" }, "A trajectory file (docs: clearloci trajectory), read in this browser:"), text, h("div", { class: "buttons" }, open, h("button", { type: "button", id: "follow-trajectory", click: () => bench.change({ trajectory: text.value || undefined }) }, "Follow"), h("button", { type: "button", click: () => useExample() }, "The example's path")), fault, player, errors.element, losses);
  let started: number | undefined;

  const useExample = (): void => {
    const path = bench.start.companions.find((one) => one.name.endsWith("/path.yaml"));
    const manipulator = bench.start.examples.find((one) => one.name.endsWith("/manipulator.yaml"));
    if (path && manipulator) bench.change({ text: manipulator.text, file: "manipulator.yaml", trajectory: path.text, at: undefined, mode: undefined, task: undefined });
  };
  open.addEventListener("change", () => void open.files?.[0]?.text().then((read) => bench.change({ trajectory: read })));

  const samples = (): number[] => (bench.trajectory?.samples["time"] ?? []).map((value) => value ?? 0);
  const goTo = (seconds: number): void => {
    const { trajectory } = bench;
    if (!trajectory) return;
    const times = samples();
    const k = Math.max(0, times.findIndex((one) => one >= seconds));
    const at = bench.coordinates.map((coordinate) => trajectory.samples[`q_${coordinate.name}`]?.[k] ?? 0);
    time.value = String(seconds);
    clock.textContent = `${seconds.toFixed(2)} s`;
    bench.change({ at }, "play");
  };
  const tick = (now: number): void => {
    const period = bench.trajectory?.period ?? 0;
    if (started === undefined || period === 0) return;
    goTo(((now - started) / 1000) % period);
    requestAnimationFrame(tick);
  };
  play.addEventListener("click", () => {
    if (started !== undefined) started = undefined;
    else {
      started = performance.now() - Number(time.value) * 1000;
      requestAnimationFrame(tick);
    }
    play.textContent = started === undefined ? "Play" : "Pause";
    if (started === undefined) bench.history.endGesture();
  });
  time.addEventListener("input", () => goTo(Number(time.value)));

  const update = (): void => {
    const { trajectory, state, theme } = bench;
    if (document.activeElement !== text) text.value = state.trajectory ?? text.value;
    fault.textContent = bench.trajectoryFault ?? "";
    for (const part of [player, errors.element, losses]) part.hidden = !trajectory;
    if (!trajectory) return;
    element.open = true;
    time.max = String(trajectory.period);
    const times = samples();
    const small = smallUnit(bench.units);
    const column = (name: string): (number | null)[] => (trajectory.samples[name] ?? []).map((value) => (value === null ? null : value / small.size));
    errors.show({ xLabel: "time (s)", yLabel: small.name, x: times, series: ["dx", "dy"].map((name) => ({ label: name, values: column(name) })), marks: trajectory.contact_losses.map((loss) => loss.time) }, theme);
    replace(losses, ...trajectory.contact_losses.slice(0, 40).map((loss) => h("li", {}, h("button", { type: "button", click: () => goTo(loss.time) }, `${loss.time.toFixed(4)} s`), ` ${loss.quantity}_${loss.joint} (${loss.kind})`)), trajectory.contact_losses.length === 0 ? h("li", { class: "good" }, "contact is never lost") : undefined, ...trajectory.stages.map((stage) => h("li", { class: "quiet" }, `${stage.from} to ${stage.to}: no contact lost above a period of ${shortNumber(stage.critical_period)} s`)));
  };
  errors.onCursor = goTo;
  return { element, update: (news) => (news.has("trajectory") || news.has("theme") || news.has("state")) && update() };
}
