// Reactions and errors along the path of a task, or over the cycle of a linkage.
import { smallUnit, unitOf } from "../data/units";
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
  const hint = h("p", { class: "quiet" }, "Draw a task to see reactions and errors along its outline.");
  const plots = h("div", {}, forces.element, couples.element, errors.element);
  const element = section("Plots", false, hint, plots);
  let way: Way | undefined;

  const cycle = (): boolean => bench.coordinates.length === 1;
  const inUnits = (one: Way | undefined): Way | undefined => one && { ...one, x: one.x.map((value) => value / bench.units.length.size), label: one.label.replace("(m)", `(${bench.units.length.name})`) };
  const wayNow = (): Way | undefined => {
    const [only] = bench.coordinates;
    if (cycle() && only) {
      const values = alongCycle(only.lower, only.upper, 360);
      const unit = unitOf(bench.units, only.angle);
      return { x: values.map((value) => value / unit.size), poses: values, label: `${only.name} (${unit.name})` };
    }
    return bench.overTwoLengths && bench.state.task ? inUnits(alongPath(outline(bench.state.task.shape), steps)) : undefined;
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
    const { size } = unitOf(bench.units, bench.coordinates[0]?.angle ?? false);
    return cycle() ? (bench.picture?.loci.isolated_points ?? []).filter((point) => point.kind !== "workspace-boundary").map((point) => (point.at[0] ?? 0) / size) : [];
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
    const inForce = (values: (number | null)[]): (number | null)[] => values.map((value) => (value === null ? null : value / bench.units.force.size));
    const small = smallUnit(bench.units);
    forces.show({ xLabel: label, yLabel: bench.units.force.name, x, series: magnitudes().slice(0, 12).map(([joint, values]) => ({ label: joint, values: inForce(clipped(values)) })), marks: marks() }, theme);
    const acting = Object.entries(sweep.answer.reactions).filter(([, column]) => column.quantity === "M" || column.quantity === "F");
    couples.element.hidden = acting.length === 0;
    if (acting.length > 0) couples.show({ xLabel: label, yLabel: acting[0]?.[1].unit ?? "", x, series: acting.map(([name, column]) => ({ label: name, values: clipped(column.values) })), marks: marks() }, theme);
    const names = bench.facts?.spatial ? ["dx", "dy", "dz"] : ["dx", "dy"];
    errors.show({ xLabel: label, yLabel: small.name, x, series: names.map((name, k) => ({ label: name, values: clipped(sweep.answer.errors.map((error) => (error?.[k] === null || error?.[k] === undefined ? null : error[k] / small.size))) })), marks: marks() }, theme);
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
      replace(hint, cycle() ? "" : "Draw a task to see reactions and errors along its outline.");
    },
  };
}
