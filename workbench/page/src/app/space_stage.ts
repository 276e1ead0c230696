// The stage of three coordinates.
import { roundText, shortNumber } from "../data/exact";
import { unitOf } from "../data/units";
import { axesIn } from "../space/axes";
import { barsOf } from "../space/bars";
import { h, replace } from "./dom";
import type { Panel } from "./panels";
import { readingOf } from "./reading";
import { verdictColour } from "./stage_drawing";
import type { Workbench } from "./workbench";
import type { Space as SpaceScene } from "../space/scene";
import { Space } from "../space/scene";

export class SpaceStage implements Panel {
  readonly element = h("div", { class: "stage space", tabindex: 0, role: "application", "aria-label": "Surfaces on which reactions vanish. Arrow keys turn them, + and - zoom; drag the ball, which is the end effector." });
  readonly controls: HTMLElement;
  private scene: SpaceScene | undefined;
  private fault: string | undefined;
  private held = false;
  private readonly axis = h("select", { "aria-label": "Slice across" });
  private readonly slider = h("input", { type: "range", step: "any", "aria-label": "Place of the slice" });
  private readonly on = h("input", { type: "checkbox" });
  private readonly words = h("span", { class: "quiet" });
  private readonly under = h("div", { class: "under" });

  constructor(private readonly bench: Workbench) {
    this.controls = h("div", { class: "slice" }, h("label", { class: "tick" }, this.on, "slice"), this.axis, this.slider, this.words);
    const change = (gesture?: string): void => {
      const axis = Number(this.axis.value);
      const range = bench.coordinates[axis];
      const before = bench.state.slice;
      const at = before?.axis === axis || gesture ? Number(this.slider.value) : range ? (range.lower + range.upper) / 2 : 0;
      bench.change({ slice: { on: this.on.checked, axis, at } }, gesture);
    };
    this.on.addEventListener("change", () => change());
    this.axis.addEventListener("change", () => change());
    this.slider.addEventListener("input", () => {
      this.on.checked = true;
      change("slice");
    });
    this.slider.addEventListener("change", () => bench.history.endGesture());
    this.element.append(this.under);
    // Before the canvas hears of it, which turns the view.
    this.element.addEventListener("pointerdown", (event) => this.press(event), { capture: true });
    this.element.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const) this.element.addEventListener(end, () => this.release());
    this.element.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.scene?.resize(this.element.clientWidth, this.element.clientHeight)).observe(this.element);
  }

  private open(): SpaceScene | undefined {
    if (this.scene || this.fault) return this.scene;
    try {
      this.scene = new Space(this.element);
      // For tests, as the plane says how it is scaled.
      this.scene.onDrawn = () => (this.element.dataset["pose"] = JSON.stringify(this.scene?.poseOnCanvas ?? null));
      this.scene.resize(this.element.clientWidth, this.element.clientHeight);
    } catch {
      this.fault = "this browser has no WebGL, which draws the surfaces";
      replace(this.under, this.fault);
    }
    return this.scene;
  }

  update(news: Set<string>): void {
    const { bench } = this;
    const spatial = bench.coordinates.length === 3;
    this.element.hidden = this.controls.hidden = !spatial;
    if (!spatial || !bench.picture || bench.picture.loci.coordinates.length !== 3) return;
    const scene = this.open();
    const names = bench.coordinates.map((one) => one.name).join();
    if (this.axis.dataset["names"] !== names) replace(this.axis, ...bench.coordinates.map((one, k) => h("option", { value: k }, one.name)));
    this.axis.dataset["names"] = names;
    const slice = bench.state.slice ?? { axis: 2, at: middleOf(bench, 2), on: false };
    const range = bench.coordinates[slice.axis];
    this.axis.value = String(slice.axis);
    this.on.checked = slice.on;
    this.slider.min = String(range?.lower ?? 0);
    this.slider.max = String(range?.upper ?? 1);
    this.slider.value = String(slice.at);
    const unit = unitOf(bench.units, range?.angle ?? false);
    this.words.textContent = `${range?.name ?? ""} = ${shortNumber(slice.at / unit.size)} ${unit.name}`;
    if (["loci", "state", "theme", "model"].some((one) => news.has(one))) scene?.show(bench.picture, bench.theme, new Set(bench.state.hidden), slice, axesIn(bench.units, bench.coordinates), bench.proven);
    scene?.showPose(bench.state.at, bench.facts && bench.pose ? barsOf(bench.facts, bench.pose) : []);
    const shape = bench.state.task?.shape;
    const [low, high] = shape?.kind === "ranges" ? [shape.low, shape.high] : [];
    scene?.showTask(low, high, verdictColour(bench.verdict, bench.theme));
  }

  /** From -1 to 1 across the stage, and up. */
  private place(event: PointerEvent): [number, number] {
    const box = this.element.getBoundingClientRect();
    return [(2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height];
  }

  private isOnPose(event: PointerEvent): boolean {
    const at = this.scene?.poseOnCanvas;
    const box = this.element.getBoundingClientRect();
    const reach = 16; // pixels
    return at !== undefined && Math.hypot(event.clientX - box.left - at[0], event.clientY - box.top - at[1]) <= reach;
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0 || !this.isOnPose(event)) return;
    event.stopPropagation();
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    this.element.dataset["grip"] = "pose";
    this.held = true;
  }

  private release(): void {
    if (!this.held) return;
    this.held = false;
    delete this.element.dataset["grip"];
    this.bench.history.endGesture();
  }

  private move(event: PointerEvent): void {
    if (!this.held) return this.hover(event);
    const to = this.scene?.dragged(...this.place(event));
    if (to) this.bench.change({ at: to.map((value, k) => roundedWithin(value, this.bench.coordinates[k])) }, "drag-pose");
  }

  private hover(event: PointerEvent): void {
    if (event.buttons !== 0) return;
    this.element.style.cursor = this.isOnPose(event) ? "grab" : "default";
    const id = this.scene?.at(...this.place(event));
    const surface = this.bench.picture?.loci.surfaces?.find((one) => one.id === id);
    replace(this.under, surface ? readingOf(this.bench.rules, surface) : undefined);
  }

  private key(event: KeyboardEvent): void {
    const way = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (way) {
      event.preventDefault();
      this.scene?.turn(way[0] ?? 0, way[1] ?? 0);
    } else if (event.key === "+" || event.key === "=") this.scene?.zoom(1.2);
    else if (event.key === "-") this.scene?.zoom(1 / 1.2);
  }
}

/** Within the range of the coordinate, on a grid of two thousand steps or finer. */
function roundedWithin(value: number, range: { lower: number; upper: number } | undefined): number {
  if (!range) return value;
  const kept = Math.min(range.upper, Math.max(range.lower, value));
  return Number(roundText(kept, (range.upper - range.lower) / 2000));
}

function middleOf(bench: Workbench, axis: number): number {
  const range = bench.coordinates[axis];
  return range ? (range.lower + range.upper) / 2 : 0;
}
