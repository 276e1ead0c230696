// The range of the one coordinate: what is reached, marks where reactions vanish, and where the linkage is.
import type { Point } from "../data/answers";
import { colourOf, drawMarker, groupKey } from "../draw/loci";
import { Layer } from "../draw/surface";
import { ticks, tickText } from "../draw/view";
import { unitOf } from "../data/units";
import { h } from "./dom";
import { verdictColour } from "./stage_drawing";
import type { Workbench } from "./workbench";

const margin = 30;

export class CycleStrip {
  readonly element = h("div", { class: "cycle", tabindex: 0, role: "slider", "aria-label": "The coordinate of the linkage" });
  private readonly layer: Layer;
  private held: "low" | "high" | undefined;

  constructor(private readonly bench: Workbench) {
    this.layer = new Layer(this.element, "cycle");
    new ResizeObserver(() => this.draw()).observe(this.element);
    const drag = (event: PointerEvent): void => {
      const range = bench.coordinates[0];
      if (!range || event.buttons !== 1) return;
      const part = Math.min(1, Math.max(0, (event.offsetX - margin) / (this.element.clientWidth - 2 * margin)));
      const to = Number((range.lower + part * (range.upper - range.lower)).toPrecision(6));
      if (this.held) this.moveEnd(to);
      else bench.change({ at: [to] }, "cycle");
    };
    this.element.addEventListener("pointerdown", (event) => {
      this.element.setPointerCapture(event.pointerId);
      this.held = this.endAt(event.offsetX);
      drag(event);
    });
    this.element.addEventListener("pointermove", drag);
    this.element.addEventListener("pointerup", () => bench.history.endGesture());
    this.element.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      const range = bench.coordinates[0];
      const at = bench.state.at?.[0];
      if (!way || !range || at === undefined) return;
      event.preventDefault();
      bench.change({ at: [Number((at + way * (event.shiftKey ? 0.001 : 0.01) * (range.upper - range.lower)).toPrecision(12))] }, "key-pose");
    });
    bench.watch(() => this.draw());
  }

  /** The end of the task's range that a press at this place takes hold of. */
  private endAt(place: number): "low" | "high" | undefined {
    const [range] = this.bench.coordinates;
    const shape = this.bench.state.task?.shape;
    if (!range || shape?.kind !== "ranges") return undefined;
    const reach = 6; // pixels
    const scale = (this.element.clientWidth - 2 * margin) / (range.upper - range.lower);
    return (["low", "high"] as const).find((end) => Math.abs(margin + ((shape[end][0] ?? 0) - range.lower) * scale - place) <= reach);
  }

  private moveEnd(to: number): void {
    const { task } = this.bench.state;
    if (!this.held || task?.shape.kind !== "ranges") return;
    const shape = { ...task.shape, [this.held]: [to] };
    if ((shape.low[0] ?? 0) <= (shape.high[0] ?? 0)) this.bench.change({ task: { ...task, shape } }, "drag-task");
  }

  private draw(): void {
    const [range] = this.bench.coordinates;
    this.element.hidden = this.bench.coordinates.length !== 1;
    if (!range || this.element.hidden) return;
    const size = { width: this.element.clientWidth, height: this.element.clientHeight };
    this.layer.resize(size);
    const context = this.layer.begin();
    const { picture, theme, state, units } = this.bench;
    const unit = unitOf(units, range.angle);
    const x = (value: number): number => margin + ((value - range.lower) / (range.upper - range.lower)) * (size.width - 2 * margin);
    const y = 30;
    this.element.setAttribute("aria-valuenow", String(state.at?.[0] ?? 0));
    context.fillStyle = theme.workspace;
    for (const piece of picture?.loci.reachable ?? []) context.fillRect(x(piece.from), y - 12, x(piece.to) - x(piece.from), 24);
    const shape = state.task?.shape;
    if (shape?.kind === "ranges") {
      const [from, to] = [x(shape.low[0] ?? 0), x(shape.high[0] ?? 0)];
      context.fillStyle = context.strokeStyle = verdictColour(this.bench.verdict, theme);
      context.globalAlpha = 0.25;
      context.fillRect(from, y - 12, to - from, 24);
      context.globalAlpha = 1;
      context.lineWidth = 2;
      context.strokeRect(from, y - 12, to - from, 24);
      context.lineWidth = 1;
    }
    context.strokeStyle = theme.frame;
    context.beginPath();
    context.moveTo(x(range.lower), y);
    context.lineTo(x(range.upper), y);
    context.stroke();
    context.fillStyle = theme.faded_ink;
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    for (const tick of ticks(range.lower, range.upper, (size.width - 2 * margin) / (range.upper - range.lower), 56, unit)) {
      context.fillText(tickText(tick, unit), x(tick), 70);
      context.fillRect(x(tick), y + 12, 1, 4);
    }
    const hidden = new Set(state.hidden);
    for (const group of picture?.point_groups ?? []) {
      if (hidden.has(groupKey(group))) continue;
      for (const index of group.points) {
        const value = picture?.loci.isolated_points[index]?.at[0];
        if (value !== undefined) drawMarker(context, [x(value), y] as Point, group.shape, colourOf(theme, group.colour), theme);
      }
    }
    const at = state.at?.[0];
    if (at === undefined) return;
    context.strokeStyle = theme.ink;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x(at), 8);
    context.lineTo(x(at), 52);
    context.stroke();
    context.fillStyle = theme.ink;
    context.textAlign = "left";
    context.font = "600 12px system-ui, sans-serif";
    context.fillText(`${range.name} = ${Number((at / unit.size).toPrecision(5))} ${unit.name}`, Math.min(x(at) + 6, size.width - 130), 16);
  }
}
