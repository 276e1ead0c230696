// Reactions and errors along the path of a task, or over the cycle of a linkage.
import { h, replace, section } from "./dom";
import type { Panel } from "./panels";
import { Plot } from "./plot";
import { alongCycle, alongPath, type Way } from "./way";
import { outline } from "./task_text";
import type { Workbench } from "./workbench";

const steps = 240;

export function plotsPanel(bench: Workbench): Panel {
  const forces = new Plot("Reactions");
  const couples = new Plot("Actuators");
  const errors = new Plot("Pose error");
  const hint = h("p", { class: "quiet" }, "Draw a task: reactions and errors along its outline stand here.");
  const plots = h("div", {}, forces.element, couples.element, errors.element);
  const element = section("Plots", false, hint, plots);
  let way: Way | undefined;

  const cycle = (): boolean => bench.coordinates.length === 1;
  const wayNow = (): Way | undefined => {
    const [only] = bench.coordinates;
    if (cycle() && only) {
      const values = alongCycle(only.lower, only.upper, 360);
      const factor = only.angle ? 180 / Math.PI : 1;
      return { x: values.map((value) => value * factor), poses: values, label: `${only.name} (${only.angle ? "deg" : "m"})` };
    }
    return bench.overTwoLengths && bench.state.task ? alongPath(outline(bench.state.task.shape), steps) : undefined;
  };
  const wanted = (): boolean => cycle() || (element.open && bench.state.task !== undefined);
  let asked = "";
  const askAgain = (): void => {
    if (!wanted()) return;
    const next = wayNow();
    if (!next) return;
    const now = JSON.stringify([bench.state.text, bench.state.mode, next.poses]);
    if (now === asked) return;
    asked = now;
    way = next;
    bench.askSweep(next.poses);
  };
  element.addEventListener("toggle", askAgain);

  const magnitudes = (): [string, (number | null)[]][] => {
    const joints = new Map<string, (number | null)[]>();
    for (const column of Object.values(bench.sweep?.answer.reactions ?? {})) {
      if (!/^f[xyz]$/.test(column.quantity)) continue;
      const sum = joints.get(column.joint) ?? column.values.map(() => 0);
      joints.set(column.joint, sum.map((one, k) => {
        const own = column.values[k];
        return one === null || own === null || own === undefined ? null : Math.hypot(one, own);
      }));
    }
    return [...joints];
  };
  const marks = (): number[] => {
    const factor = bench.coordinates[0]?.angle ? 180 / Math.PI : 1;
    return cycle() ? (bench.picture?.loci.isolated_points ?? []).filter((point) => point.kind !== "workspace-boundary").map((point) => (point.at[0] ?? 0) * factor) : [];
  };

  const show = (): void => {
    const { sweep, theme } = bench;
    hint.hidden = wayNow() !== undefined;
    plots.hidden = !sweep || wayNow() === undefined;
    if (!sweep || !way || !element.open || sweep.coordinate !== way.poses) return;
    const { x, label } = way;
    const clipped = (values: (number | null)[]): (number | null)[] => {
      const sizes = values.flatMap((value) => (value === null ? [] : [Math.abs(value)])).sort((a, b) => a - b);
      const limit = 20 * (sizes[Math.floor(sizes.length / 2)] ?? 1) || Infinity; // near a singularity they grow without bound
      return values.map((value) => (value !== null && Math.abs(value) > limit ? null : value));
    };
    forces.show({ xLabel: label, yLabel: "N", x, series: magnitudes().slice(0, 12).map(([joint, values]) => ({ label: joint, values: clipped(values) })), marks: marks() }, theme);
    const acting = Object.entries(sweep.answer.reactions).filter(([, column]) => column.quantity === "M" || column.quantity === "F");
    couples.element.hidden = acting.length === 0;
    if (acting.length > 0) couples.show({ xLabel: label, yLabel: acting[0]?.[1].unit ?? "", x, series: acting.map(([name, column]) => ({ label: name, values: clipped(column.values) })), marks: marks() }, theme);
    const names = bench.facts?.spatial ? ["dx", "dy", "dz"] : ["dx", "dy"];
    errors.show({ xLabel: label, yLabel: "mm", x, series: names.map((name, k) => ({ label: name, values: clipped(sweep.answer.errors.map((error) => (error?.[k] === null || error?.[k] === undefined ? null : error[k] * 1e3))) })), marks: marks() }, theme);
  };
  for (const plot of [forces, couples, errors]) {
    plot.onCursor = (at) => {
      const [only] = bench.coordinates;
      if (cycle() && only) bench.change({ at: [Number((only.angle ? (at * Math.PI) / 180 : at).toPrecision(8))] }, "plot-cursor");
      else if (way) {
        const k = Math.min(way.x.length - 1, Math.max(0, way.x.findIndex((one) => one >= at)));
        bench.change({ at: way.poses.slice(2 * k, 2 * k + 2) }, "plot-cursor");
      }
    };
  }
  return {
    element,
    update: (news) => {
      if (news.has("model") || news.has("state") || news.has("loci")) askAgain();
      if (["sweep", "theme", "loci", "model", "state"].some((one) => news.has(one))) show();
      if (cycle() && news.has("model")) element.open = true;
      replace(hint, cycle() ? "" : "Draw a task: reactions and errors along its outline stand here.");
    },
  };
}
