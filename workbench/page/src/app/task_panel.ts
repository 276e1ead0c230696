// A task: drawn, dragged, verified while it moves, moved to where it fits.
import type { Verdict } from "../data/answers";
import { shortNumber } from "../data/exact";
import { lengthWords, placeWords, type Units } from "../data/units";
import { ask, AskingError } from "./asking";
import { download, h, replace, section } from "./dom";
import type { Panel } from "./panels";
import type { Stage } from "./stage";
import { noDemands, type TaskShape, type TaskState } from "./state";
import { showNumbers } from "./task_numbers";
import { movedShape } from "./task_text";
import type { Workbench } from "./workbench";

function verdictWords(verdict: Verdict, bench: Workbench): string {
  switch (verdict.verdict) {
    case "verified":
      return `Verified: no locus, singularity or boundary in the task, proven.${marginWords(verdict, bench.units)}`;
    case "refuted":
      return `Refuted: ${verdict.reason_shown ?? verdict.witness?.reason ?? "it fails"} at ${placeWords(verdict.witness?.at ?? [], bench.coordinates.map((one) => one.angle), bench.units)}.`;
    default:
      return `Undecided: neither proven nor refuted; ${verdict.open?.reason ?? ""}.`;
  }
}

/** Of lengths and of angles, as far as the task has them. */
function marginWords(verdict: Verdict, units: Units): string {
  const margins = [
    ...(typeof verdict.margin === "number" ? [lengthWords(verdict.margin, units)] : []),
    ...(typeof verdict.angle_margin === "number" ? [`${shortNumber(verdict.angle_margin / units.angle.size)} ${units.angle.name}`] : []),
  ];
  return margins.length > 0 ? ` Margin at least ${margins.join(" and ")}.` : "";
}

/** What can be drawn over the free coordinates: among loci and zones, over a plane with an angle, over others. */
function kindsOf(bench: Workbench): TaskShape["kind"][] {
  if (bench.overTwoLengths) return ["box", "circle", "polygon", "path"];
  return bench.coordinates.length === 2 ? ["box", "path"] : ["ranges"];
}

/** Amid what is reached, some of the box large. */
function firstShape(kind: TaskShape["kind"], bench: Workbench): TaskShape {
  const [x, y] = bench.coordinates;
  const at = bench.state.at ?? [0, 0];
  const sizes = [x, y].map((one) => 0.08 * ((one?.upper ?? 1) - (one?.lower ?? 0)));
  const least = Math.min(...sizes);
  const size = (axis: 0 | 1): number => (bench.overTwoLengths ? least : sizes[axis] ?? least);
  const { metres } = bench.model; // round in the file's unit
  const round = (value: number): number => Number((Number((value / metres).toPrecision(3)) * metres).toPrecision(12));
  const place = (dx: number, dy: number): [number, number] => [round((at[0] ?? 0) + dx * size(0)), round((at[1] ?? 0) + dy * size(1))];
  switch (kind) {
    case "box":
      return { kind, low: place(-1, -1), high: place(1, 1) };
    case "circle":
      return { kind, centre: place(0, 0), radius: round(least) };
    case "ranges": {
      const part = bench.coordinates.map((one, k) => ({ at: at[k] ?? 0, half: 0.05 * (one.upper - one.lower), ...one }));
      return { kind, low: part.map((one) => round(Math.max(one.lower, one.at - one.half))), high: part.map((one) => round(Math.min(one.upper, one.at + one.half))) };
    }
    case "polygon":
      return { kind, points: [place(-1, -1), place(1, -1), place(0, 1)] };
    case "path":
      return { kind, points: [place(-1, -0.6), place(-1, 0.6), place(1, 0.6), place(1, -0.6)] };
  }
}

/** A tenth of a percent of the first parameter that is a number. */
function toleranceHint(bench: Workbench): string {
  const first = bench.model.adjustables.find((one) => one.group === "parameters" && one.value !== undefined && one.path.length === 2);
  return first?.value ? `${first.label}: ${shortNumber(Math.abs(first.value) / 1000, 2)}` : "L: 0.1e-3";
}

export function taskPanel(bench: Workbench, stage: Stage): Panel {
  const words = h("p", { class: "verdict", "aria-live": "polite" });
  const fault = h("div", { class: "fault", role: "alert" });
  const fields = h("div", {});
  const shapes = h("div", { class: "buttons" });
  const tools = h("div", { class: "buttons" });
  const ranges = h("div", { class: "ranges" });

  const start = (kind: TaskShape["kind"]): void => {
    const shape = firstShape(kind, bench);
    bench.look(false); // it is drawn among the loci
    bench.change({ task: { ...noDemands, ...bench.state.task, shape } });
    stage.showAll();
    stage.arm(kind === "ranges" ? undefined : kind);
  };
  const drawing = h("p", { class: "quiet" });
  stage.onArmed = (kind) => {
    for (const button of shapes.querySelectorAll("button")) button.setAttribute("aria-pressed", String(button.textContent === kind));
    drawing.textContent = kind ? `Drag on the empty plane to draw the ${kind} (Esc ends this), or move the task.` : "";
  };
  const set = (part: Partial<TaskState>): void => {
    if (bench.state.task) bench.change({ task: { ...bench.state.task, ...part } });
  };
  const field = (name: keyof Omit<TaskState, "shape">, label: string, unit: string, hint: string): HTMLElement => {
    const input = h("input", { type: "text", class: "exact", placeholder: hint, "aria-label": label, autocomplete: "off", "data-task": name });
    input.addEventListener("change", () => set({ [name]: input.value.trim() }));
    return h("label", { class: "task-row" }, h("span", { class: "value-name" }, label), input, h("span", { class: "unit", "data-unit": unit }));
  };
  const fit = async (goal: "nearest" | "best"): Promise<void> => {
    const { task } = bench.state;
    if (!task) return;
    words.textContent = "Looking for a place …";
    try {
      const verdict = await ask<Verdict>("verify", { text: bench.state.text, file: bench.state.file, mode: bench.state.mode ?? [], task: bench.taskFile(task), fit: goal, lane: "fit" });
      if (verdict.moved_by) set({ shape: movedShape(task.shape, verdict.moved_by) });
      else words.textContent = verdict.verified ? "It fits where it is." : "No place was found at which the task is verified.";
    } catch (error) {
      if (!(error instanceof AskingError)) throw error;
      update();
      fault.textContent = error.fault.message;
    }
  };
  tools.append(
    h("button", { type: "button", title: "Move the task to the nearest place where it is verified", click: () => void fit("nearest") }, "Fit nearest"),
    h("button", { type: "button", title: "Move the task to the place with the largest margin", click: () => void fit("best") }, "Fit best"),
    h("button", { type: "button", click: () => addPoint() }, "Add a point"),
    h("button", { type: "button", title: "Show the pose and the design at which the task fails", click: () => goToWitness() }, "Show the witness"),
    h("button", { type: "button", click: () => bench.state.task && download("task.yaml", bench.taskFile(bench.state.task), "application/yaml") }, "Download"),
    h("button", { type: "button", click: () => {
      stage.arm(undefined);
      bench.change({ task: undefined });
    } }, "Remove"),
  );
  const goToWitness = (): void => {
    const witness = bench.verdict?.witness;
    if (!witness) return;
    let { model } = bench;
    for (const [name, value] of Object.entries(witness.design ?? {})) model = model.write(["parameters", name], String(value));
    bench.change({ at: witness.at, text: model.text });
  };
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
    field("loadsWithin", "loads off by", "", "{load: 1, radius: 20}"),
    field("tolerances", "tolerances", "", toleranceHint(bench)),
  );
  const intro = h("p", { class: "quiet" }, "The poses that the end effector has to reach without a loss of contact:");
  const element = section("Task", false, intro, shapes, drawing, words, fault, ranges, fields, tools);
  let offered = "";
  const offer = (): void => {
    const kinds = kindsOf(bench);
    if (offered === kinds.join()) return;
    offered = kinds.join();
    replace(shapes, ...kinds.map((kind) => h("button", { type: "button", click: () => start(kind) }, kind === "ranges" ? "box" : kind)));
  };

  const update = (): void => {
    const { task } = bench.state;
    offer();
    for (const part of [fields, tools, words, ranges]) part.hidden = !task;
    if (!task) {
      fault.textContent = "";
      return;
    }
    element.open = true;
    fault.textContent = bench.taskFault ?? "";
    // What is typed is in the units of the mechanism file, as in a task file.
    const units: Record<string, string> = { m: bench.model.unit(bench.coordinates.every((one) => one.angle) ? "angle" : "length"), N: bench.model.unit("force"), "N m": `${bench.model.unit("force")} m` };
    for (const unit of fields.querySelectorAll<HTMLElement>("[data-unit]")) unit.textContent = units[unit.dataset["unit"] ?? ""] ?? "";
    for (const input of fields.querySelectorAll("input")) {
      const name = input.dataset["task"] as keyof Omit<TaskState, "shape">;
      if (document.activeElement !== input) input.value = task[name];
    }
    showNumbers(ranges, bench);
    for (const name of ["tolerances", "loadsWithin"]) {
      const row = fields.querySelector<HTMLElement>(`[data-task="${name}"]`)?.closest("label");
      if (row) row.hidden = !bench.overTwoLengths;
    }
    const [nearest, best, addition, witness] = tools.querySelectorAll("button");
    if (nearest && best) nearest.hidden = best.hidden = !bench.overTwoLengths;
    if (addition) addition.hidden = task.shape.kind !== "polygon" && task.shape.kind !== "path";
    if (witness) witness.hidden = !bench.verdict?.witness;
    const { verdict } = bench;
    words.textContent = verdict ? verdictWords(verdict, bench) : bench.taskFault ? "" : "…";
    words.className = `verdict ${verdict?.verdict === "verified" ? "good" : verdict?.verdict === "refuted" ? "fault" : "quiet"}`;
  };
  return { element, update: (news) => (news.has("verify") || news.has("state") || news.has("model")) && update() };
}
