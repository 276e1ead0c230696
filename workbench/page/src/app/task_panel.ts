// A task: drawn, dragged, verified while it moves, moved to where it fits.
import type { Verdict } from "../data/answers";
import { lengthWords } from "../data/exact";
import { ask, AskingError } from "./asking";
import { download, h, replace, section } from "./dom";
import type { Panel } from "./panels";
import type { Stage } from "./stage";
import type { TaskShape, TaskState } from "./state";
import { movedShape, taskText } from "./task_text";
import type { Workbench } from "./workbench";

function verdictWords(verdict: Verdict): string {
  switch (verdict.verdict) {
    case "verified":
      return `Verified: no locus, singularity or boundary in the task, proven. Margin at least ${lengthWords(verdict.margin)}.`;
    case "refuted":
      return `Refuted: ${verdict.witness?.reason ?? "it fails"} at (${verdict.witness?.at.map((value) => value.toPrecision(4)).join(", ") ?? ""}).`;
    default:
      return `Undecided: neither proven nor refuted; ${verdict.open?.reason ?? ""}.`;
  }
}

/** Amid what is reached, some of the box large. */
function firstShape(kind: TaskShape["kind"], bench: Workbench): TaskShape {
  const [x, y] = bench.coordinates;
  const at = bench.state.at ?? [0, 0];
  const size = 0.08 * Math.min((x?.upper ?? 1) - (x?.lower ?? 0), (y?.upper ?? 1) - (y?.lower ?? 0));
  const round = (value: number): number => Number(value.toPrecision(3));
  const place = (dx: number, dy: number): [number, number] => [round((at[0] ?? 0) + dx * size), round((at[1] ?? 0) + dy * size)];
  switch (kind) {
    case "box":
      return { kind, low: place(-1, -1), high: place(1, 1) };
    case "circle":
      return { kind, centre: place(0, 0), radius: round(size) };
    case "polygon":
      return { kind, points: [place(-1, -1), place(1, -1), place(0, 1)] };
    case "path":
      return { kind, points: [place(-1, -0.6), place(-1, 0.6), place(1, 0.6), place(1, -0.6)] };
  }
}

export function taskPanel(bench: Workbench, stage: Stage): Panel {
  const words = h("p", { class: "verdict", "aria-live": "polite" });
  const fault = h("div", { class: "fault", role: "alert" });
  const fields = h("div", {});
  const shapes = h("div", { class: "buttons" });
  const tools = h("div", { class: "buttons" });
  for (const kind of ["box", "circle", "polygon", "path"] as const)
    shapes.append(h("button", { type: "button", click: () => start(kind) }, kind));

  const start = (kind: TaskShape["kind"]): void => {
    const shape = firstShape(kind, bench);
    bench.change({ task: { margin: "", minForce: "", minCouple: "", loads: "", ...bench.state.task, shape } });
    stage.showAll();
  };
  const set = (part: Partial<TaskState>): void => {
    if (bench.state.task) bench.change({ task: { ...bench.state.task, ...part } });
  };
  const field = (name: keyof Omit<TaskState, "shape">, label: string, unit: string, hint: string): HTMLElement => {
    const input = h("input", { type: "text", class: "exact", placeholder: hint, "aria-label": label, autocomplete: "off", "data-task": name });
    input.addEventListener("change", () => set({ [name]: input.value.trim() }));
    return h("label", { class: "value-row" }, h("span", { class: "value-name" }, label), h("span"), input, h("span", { class: "unit" }, unit));
  };
  const fit = async (goal: "nearest" | "best"): Promise<void> => {
    const { task } = bench.state;
    if (!task) return;
    words.textContent = "Looking for a place …";
    try {
      const verdict = await ask<Verdict>("verify", { text: bench.state.text, mode: bench.state.mode ?? [], task: taskText(task, bench.model.coordinateNames, bench.model.taskUnit), fit: goal, lane: "fit" });
      if (verdict.moved_by) set({ shape: movedShape(task.shape, verdict.moved_by) });
      else words.textContent = verdict.verified ? "It fits where it is." : "No place was found that verifies.";
    } catch (error) {
      if (!(error instanceof AskingError)) throw error;
      fault.textContent = error.fault.message;
    }
  };
  tools.append(
    h("button", { type: "button", title: "Move it to the nearest place that verifies", click: () => void fit("nearest") }, "Fit nearest"),
    h("button", { type: "button", title: "Move it to the place with the largest margin", click: () => void fit("best") }, "Fit best"),
    h("button", { type: "button", click: () => addPoint() }, "Add a point"),
    h("button", { type: "button", click: () => bench.state.task && download("task.yaml", taskText(bench.state.task, bench.model.coordinateNames, bench.model.taskUnit), "application/yaml") }, "Download"),
    h("button", { type: "button", click: () => bench.change({ task: undefined }) }, "Remove"),
  );
  const addPoint = (): void => {
    const shape = bench.state.task?.shape;
    if (!shape || (shape.kind !== "polygon" && shape.kind !== "path")) return;
    const last = shape.points[shape.points.length - 1];
    const before = shape.points[shape.points.length - 2];
    if (last && before) set({ shape: { ...shape, points: [...shape.points.slice(0, -1), [(last[0] + before[0]) / 2, (last[1] + before[1]) / 2], last] } });
  };
  replace(
    fields,
    field("margin", "margin", "m", "0"),
    field("minForce", "least force", "N", "none"),
    field("minCouple", "least couple", "N m", "none"),
    field("loads", "loads from … to", "N", "[[-20, -100], [20, -100]]"),
  );
  const element = section("Task", false, h("p", { class: "quiet" }, "What the end effector has to reach without losing contact:"), shapes, words, fault, fields, tools);

  const update = (): void => {
    const { task } = bench.state;
    element.hidden = bench.coordinates.length !== 2 || bench.coordinates.some((one) => one.angle);
    for (const part of [fields, tools, words]) part.hidden = !task;
    if (!task) {
      fault.textContent = "";
      return;
    }
    element.open = true;
    fault.textContent = bench.taskFault ?? "";
    for (const input of fields.querySelectorAll("input")) {
      const name = input.dataset["task"] as keyof Omit<TaskState, "shape">;
      if (document.activeElement !== input) input.value = task[name];
    }
    const last = tools.querySelectorAll("button")[2];
    if (last) last.hidden = task.shape.kind !== "polygon" && task.shape.kind !== "path";
    const { verdict } = bench;
    words.textContent = verdict ? verdictWords(verdict) : bench.taskFault ? "" : "…";
    words.className = `verdict ${verdict?.verdict === "verified" ? "good" : verdict?.verdict === "refuted" ? "fault" : "quiet"}`;
  };
  return { element, update: (news) => (news.has("verify") || news.has("state") || news.has("model")) && update() };
}
