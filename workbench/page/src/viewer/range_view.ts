// Loci over one coordinate: a row a reason, a mark where it happens.
import { h, replace } from "../app/dom";
import { readingOf } from "../app/reading";
import { sameMode, type IsolatedPoint } from "../data/answers";
import { colourOf, drawMarker, groupKey } from "../draw/loci";
import { Layer } from "../draw/surface";
import { ticks, tickText, type Size } from "../draw/view";
import { unitOf, type Unit } from "../data/units";
import { themeOf, type LociView, type Settings } from "./view";

const margin = 34;

export class RangeView implements LociView {
  readonly element = h("div", { class: "viewer-stage", tabindex: 0, "aria-label": "Marks where reactions vanish; + and - zoom, arrow keys move, 0 shows all" });
  readonly hint = "Wheel: zoom. Drag: move. Double click: show all. Point at a mark to see which reactions vanish there.";
  private readonly layer: Layer;
  private size: Size = { width: 0, height: 0 };
  private range: [number, number];
  private marks: { x: number; y: number; point: IsolatedPoint }[] = [];
  private held: number | undefined;

  constructor(private readonly settings: Settings, private readonly reading: HTMLElement) {
    this.range = [...this.whole];
    this.layer = new Layer(this.element, "range");
    new ResizeObserver(() => {
      this.size = { width: this.element.clientWidth, height: this.element.clientHeight };
      this.layer.resize(this.size);
      this.draw();
    }).observe(this.element);
    this.element.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(this.value(event.offsetX), Math.exp(event.deltaY * 0.0015));
    }, { passive: false });
    this.element.addEventListener("pointerdown", (event) => {
      this.held = event.offsetX;
      this.element.setPointerCapture(event.pointerId);
    });
    this.element.addEventListener("pointerup", () => (this.held = undefined));
    this.element.addEventListener("pointermove", (event) => {
      if (this.held !== undefined) {
        this.move(this.held - event.offsetX);
        this.held = event.offsetX;
      } else this.point(event.offsetX, event.offsetY);
    });
    this.element.addEventListener("dblclick", () => this.show(this.whole));
    this.element.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -40, ArrowRight: 40 }[event.key];
      const middle = (this.range[0] + this.range[1]) / 2;
      if (by) this.move(by);
      else if (event.key === "+" || event.key === "=") this.zoom(middle, 0.8);
      else if (event.key === "-") this.zoom(middle, 1.25);
      else if (event.key === "0") this.show(this.whole);
    });
  }

  private get whole(): [number, number] {
    return this.settings.data.loci.box[0] ?? [0, 1];
  }
  private get angle(): boolean {
    return this.settings.data.loci.units?.[0] === "rad";
  }
  private get unit(): Unit {
    return unitOf(this.settings.data.units, this.angle);
  }
  private value(x: number): number {
    return this.range[0] + ((x - margin) / (this.size.width - 2 * margin)) * (this.range[1] - this.range[0]);
  }
  private x(value: number): number {
    return margin + ((value - this.range[0]) / (this.range[1] - this.range[0])) * (this.size.width - 2 * margin);
  }
  private show(range: [number, number]): void {
    this.range = [...range];
    this.draw();
  }
  private zoom(about: number, factor: number): void {
    this.show([about + (this.range[0] - about) * factor, about + (this.range[1] - about) * factor]);
  }
  private move(pixels: number): void {
    const by = (pixels / (this.size.width - 2 * margin)) * (this.range[1] - this.range[0]);
    this.show([this.range[0] + by, this.range[1] + by]);
  }

  private point(x: number, y: number): void {
    const near = this.marks.filter((mark) => Math.hypot(mark.x - x, mark.y - y) < 12)[0];
    replace(this.reading, near ? readingOf(this.settings.data.rules, near.point) : undefined);
  }

  draw(): void {
    const { data, hidden, mode } = this.settings;
    const theme = themeOf(this.settings);
    const context = this.layer.begin();
    if (this.size.width === 0) return;
    const groups = data.point_groups.filter((group) => !hidden.has(groupKey(group)));
    const bottom = this.size.height - 44;
    const step = Math.min(64, (bottom - 30) / Math.max(1, groups.length));
    context.fillStyle = theme.workspace;
    for (const piece of data.loci.reachable ?? [])
      if (!mode || sameMode(piece.working_mode, mode)) context.fillRect(this.x(piece.from), 20, this.x(piece.to) - this.x(piece.from), bottom - 20);
    context.fillStyle = theme.faded_ink;
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    const scale = (this.size.width - 2 * margin) / (this.range[1] - this.range[0]);
    for (const tick of ticks(this.range[0], this.range[1], scale, 64, this.unit)) {
      context.fillRect(this.x(tick), 20, 0.5, bottom - 20);
      context.fillText(tickText(tick, this.unit), this.x(tick), bottom + 16);
    }
    context.fillText(`${data.loci.coordinates[0] ?? ""} (${this.unit.name})`, this.size.width / 2, bottom + 34);
    this.marks = [];
    groups.forEach((group, row) => {
      const y = 40 + (row + 0.5) * step;
      context.textAlign = "left";
      context.fillStyle = theme.ink;
      context.fillText(group.what.replace("isolated points — ", ""), margin + 4, y - 14);
      for (const index of group.points) {
        const point = data.loci.isolated_points[index];
        if (!point || (mode && !sameMode(point.working_mode, mode))) continue;
        const x = this.x(point.at[0] ?? 0);
        drawMarker(context, [x, y], group.shape, colourOf(theme, group.colour), theme);
        this.marks.push({ x, y, point });
      }
    });
  }
}
