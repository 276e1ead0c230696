// The page that `--export html` writes: the loci as in the pictures, to point at, to zoom and to switch, without a server.
import "../style/common.css";
import "./viewer.css";
import type { ModeNames, Picture, Rules } from "../data/answers";
import { h, replace } from "../app/dom";
import { CurvesView } from "./curves_view";
import { glossary } from "./glossary";
import { legend } from "./legend";
import { RangeView } from "./range_view";
import { SurfacesView } from "./surfaces_view";
import type { LociView, Settings } from "./view";

function wordsOf(mode: ModeNames): string {
  return Object.entries(mode).map(([point, side]) => `${point} ${side}`).join(", ");
}

function main(): void {
  const data = JSON.parse(document.getElementById("loci")?.textContent ?? "{}") as Picture & { rules: Rules };
  const root = document.getElementById("viewer");
  if (!root) return;
  const modes = [...new Map([...data.loci.workspace, ...(data.loci.reachable ?? []), ...data.loci.curves, ...(data.loci.surfaces ?? []), ...data.loci.isolated_points].map((one) => [JSON.stringify(one.working_mode), one.working_mode])).values()];
  const settings: Settings = { data, hidden: new Set(), mode: modes[0], dark: window.matchMedia("(prefers-color-scheme: dark)").matches };
  const reading = h("div", { class: "reading", "aria-live": "polite" });
  const count = data.loci.coordinates.length;
  const view: LociView = count === 1 ? new RangeView(settings, reading) : count === 2 ? new CurvesView(settings, reading) : new SurfacesView(settings, reading);
  const rows = h("div", { class: "legend" });
  const refresh = (): void => {
    document.documentElement.dataset["theme"] = settings.dark ? "dark" : "light";
    replace(rows, ...legend(settings, refresh));
    view.draw();
  };
  const modeBox = h("select", { "aria-label": "Working mode", change: () => {
    settings.mode = modes[Number(modeBox.value)];
    refresh();
  } }, ...modes.map((mode, k) => h("option", { value: k }, wordsOf(mode) || "the only one")));
  const parameters = data.parameters.length > 0 ? h("details", { open: true }, h("summary", {}, "Parameters"), h("dl", { class: "parameters" }, ...data.parameters.flatMap((one) => [h("dt", {}, one.name), h("dd", {}, one.value)]))) : undefined;
  const theme = h("button", { type: "button", click: () => {
    settings.dark = !settings.dark;
    refresh();
  } }, "Light or dark");
  replace(
    root,
    h("header", { class: "viewer-head" }, h("h1", {}, data.loci.mechanism), modes.length > 1 ? modeBox : h("span", { class: "quiet", "aria-label": "Working mode" }, wordsOf(modes[0] ?? {})), theme),
    h("div", { class: "viewer-body" }, view.element, h("aside", {}, reading, rows, parameters, glossary(), h("div", { class: "quiet" }, ...data.notes.map((note) => h("p", {}, note)), h("p", {}, view.hint)))),
  );
  refresh();
}

main();
