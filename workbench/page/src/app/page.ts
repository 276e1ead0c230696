// The page as a whole: head, stage and side.
import "uplot/dist/uPlot.min.css";
import { client } from "./asking";
import { CycleStrip } from "./cycle_strip";
import { h, replace } from "./dom";
import { downloadPanel } from "./download_panel";
import { buildHead } from "./head";
import { Inset } from "./inset";
import { countingPanel, legendPanel, modesPanel, readingPanel, valuesPanel, type Panel } from "./panels";
import { plotsPanel } from "./plots_panel";
import { posePanel } from "./pose_panel";
import { SpaceStage } from "./space_stage";
import { Stage } from "./stage";
import { taskPanel } from "./task_panel";
import { trajectoryPanel } from "./trajectory_panel";
import { welcome } from "./welcome";
import type { Workbench } from "./workbench";

export function buildPage(bench: Workbench, root: HTMLElement): void {
  const stage = new Stage(bench);
  const notice = h("div", { class: "notice", role: "status" });
  const panels: Panel[] = [
    readingPanel(bench, stage),
    legendPanel(bench),
    valuesPanel(bench),
    modesPanel(bench),
    posePanel(bench, stage),
    taskPanel(bench, stage),
    plotsPanel(bench),
    trajectoryPanel(bench),
    countingPanel(bench),
    downloadPanel(bench),
  ];
  const space = new SpaceStage(bench);
  stage.element.append(new Inset(bench).element);
  const main = h("div", { class: "stage-column" }, notice, stage.element, space.element, space.controls, new CycleStrip(bench).element);
  replace(root, buildHead(bench), h("main", { class: "bench" }, main, h("aside", { class: "side", "aria-label": "Design" }, ...panels.map((panel) => panel.element))), welcome(bench));

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
    stage.element.hidden = bench.coordinates.length === 3;
    space.update(news);
    panels.forEach((panel) => panel.update(news));
    const unplaced = bench.fault && !bench.fault.field ? bench.fault.message : "";
    const why = unplaced || (bench.fault ? `${nameOfField(bench)} is refused: ${bench.fault.message}` : "");
    const words = why ? `${why}${bench.picture ? " — grey is the last design that works" : ""}` : bench.poseFault ?? "";
    const busy = bench.progress ? computing(bench.progress) : "";
    document.documentElement.dataset["stale"] = String(bench.fault !== undefined);
    const beyond = bench.traceable ? "" : "Loci are drawn over one to three free coordinates: here are the pose, what the joints bear, and tasks.";
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
    if (news.lane !== "loci") return;
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
