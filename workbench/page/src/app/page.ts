// The page as a whole: head, stage and side.
import "uplot/dist/uPlot.min.css";
import { page as toPage } from "../draw/view";
import { placeOfElement } from "../drawing/element";
import { client } from "./asking";
import { CycleStrip } from "./cycle_strip";
import { h, replace } from "./dom";
import { downloadPanel } from "./download_panel";
import { drawingPanel } from "./drawing_panel";
import { DrawingStage } from "./drawing_stage";
import { Gallery } from "./gallery";
import { buildHead } from "./head";
import { Inset } from "./inset";
import { countingPanel, legendPanel, modesPanel, readingPanel, valuesPanel, type Panel } from "./panels";
import { LociInset } from "./loci_inset";
import { OnElement } from "./on_element";
import { playBar } from "./play";
import { plotsPanel } from "./plots_panel";
import { preloadPanel } from "./preload_panel";
import { posePanel } from "./pose_panel";
import { SpaceStage } from "./space_stage";
import { Stage } from "./stage";
import { taskPanel } from "./task_panel";
import { textPanel } from "./text_panel";
import { toolbar } from "./toolbar";
import { trajectoryPanel } from "./trajectory_panel";
import { welcome } from "./welcome";
import type { Workbench } from "./workbench";

export function buildPage(bench: Workbench, root: HTMLElement): void {
  const stage = new Stage(bench);
  const sheet = new DrawingStage(bench);
  const callout = h("div", { class: "callout", role: "status" });
  sheet.canvas.append(new LociInset(bench).element, callout);
  const drawn = h("div", { class: "drawing" }, toolbar(sheet), h("div", { class: "sheet-holder" }, sheet.canvas, new OnElement(bench, sheet).element));
  sheet.followers.push(() => callAt(callout, bench, sheet));
  const reading = readingPanel(bench, stage);
  const drawingSection = drawingPanel(bench);
  const gallery = new Gallery(bench);
  const notice = h("div", { class: "notice", role: "status" });
  const panels: Panel[] = [
    drawingSection,
    textPanel(bench, sheet),
    reading,
    legendPanel(bench),
    valuesPanel(bench),
    modesPanel(bench),
    preloadPanel(bench),
    posePanel(bench, stage),
    taskPanel(bench, stage),
    plotsPanel(bench),
    trajectoryPanel(bench),
    countingPanel(bench),
    downloadPanel(bench),
  ];
  const space = new SpaceStage(bench);
  stage.element.append(new Inset(bench).element);
  const main = h("div", { class: "stage-column" }, notice, drawn, stage.element, space.element, space.controls, playBar(bench, (n) => n === 1), new CycleStrip(bench).element);
  const work = h("main", { class: "bench" }, main, h("aside", { class: "side", "aria-label": "Design" }, ...panels.map((panel) => panel.element)));
  replace(root, buildHead(bench), gallery.element, work, welcome(bench));

  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const useTheme = (): void => {
    const chosen = localStorage.getItem("clearloci-theme");
    bench.dark = chosen ? chosen === "dark" : dark.matches;
    document.documentElement.dataset["theme"] = bench.dark ? "dark" : "light";
    bench.tell("theme", "state");
  };
  dark.addEventListener("change", useTheme);
  window.addEventListener("clearloci-theme", useTheme);
  useTheme();

  bench.watch((news) => {
    const { drawing } = bench.state;
    work.hidden = bench.nothing;
    drawn.hidden = drawingSection.element.hidden = !drawing;
    reading.element.hidden = drawing;
    stage.element.hidden = drawing || bench.coordinates.length === 3;
    space.update(news);
    panels.forEach((panel) => panel.update(news));
    const unplaced = bench.fault && !bench.fault.field ? bench.fault.message : "";
    const why = unplaced || (bench.fault ? `${nameOfField(bench)} is refused: ${bench.fault.message}` : "");
    const words = drawing ? "" : why ? `${why}${bench.picture ? " — grey: the last design that works" : ""}` : bench.poseFault ?? bench.missing?.words ?? "";
    const busy = bench.progress ? computing(bench.progress) : "";
    document.documentElement.dataset["loci"] = !bench.picture ? "none" : bench.proven ? "proven" : "carried";
    document.documentElement.dataset["stale"] = String(bench.fault !== undefined);
    const beyond = bench.traceable ? "" : "Loci are drawn over one to three free coordinates. For this mechanism the page shows the pose, the reactions and tasks.";
    notice.textContent = words || busy || beyond;
    notice.className = words ? "notice fault" : "notice";
    document.title = `${bench.facts?.name ?? "clearloci"} — clearloci workbench`;
  });

  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
    if (event.target instanceof HTMLInputElement && event.target.type === "text") return;
    event.preventDefault();
    if (event.shiftKey) bench.redo();
    else bench.undo();
  });

  const events = new EventSource(`api/progress?client=${client}`);
  events.onmessage = (event: MessageEvent<string>) => {
    const news = JSON.parse(event.data) as { lane: string; fraction: number; stage: string };
    if (news.lane !== "loci" || !bench.tracing) return; // news may come after the answer
    bench.progress = news;
    bench.tell("progress");
  };
}

/** The field in red, as it is called beside its slider. */
function nameOfField(bench: Workbench): string {
  return (bench.fault?.field ? bench.adjustable(bench.fault.field)?.label : undefined) ?? "the value in red";
}

/** What the server's stages do, in a visitor's words. */
const stages: Record<string, string> = {
  equations: "deriving the equations",
  roots: "solving for the places",
  cells: "searching the box",
  arcs: "tracing the curves",
  surfaces: "meshing the surfaces",
};

function computing({ stage, fraction }: { stage: string; fraction: number }): string {
  const percent = Math.round(100 * fraction);
  return `Computing the loci: ${stages[stage] ?? stage}${percent > 0 ? `, ${percent} %` : " …"}`;
}

/** What is missing or wrong, at the element that it is about. */
function callAt(callout: HTMLElement, bench: Workbench, sheet: DrawingStage): void {
  const words = bench.missing?.words ?? bench.fault?.message ?? "";
  const { wrong } = sheet;
  const place = wrong && placeOfElement(bench.drawing, wrong);
  callout.hidden = words === "";
  callout.textContent = place ? words.replace(/^[^:]+:\d+:\d+: /, "") : words; // at the thing itself its line says nothing
  callout.dataset["element"] = wrong ? ("name" in wrong ? `${wrong.kind} ${wrong.name}` : `${wrong.kind} ${wrong.index + 1}`) : "";
  const [x, y] = place ? toPage(sheet.view, place) : [12, 8];
  const { clientWidth: width, clientHeight: height } = sheet.canvas;
  const beside = place ? 16 : 0;
  callout.style.left = `${Math.max(6, Math.min(x + beside, width - callout.offsetWidth - 6))}px`;
  callout.style.top = `${Math.max(6, Math.min(y - beside - callout.offsetHeight, height - callout.offsetHeight - 6))}px`;
}
