// Loci over two coordinates: zoom by the wheel, move by dragging, point at curves.
import { h, replace } from "../app/dom";
import { readingOf } from "../app/reading";
import { sameMode, type Curve, type Point, type Sketch } from "../data/answers";
import { drawBox, drawGrid } from "../draw/axes";
import { drawCurves, drawPoints, drawWorkspace, drawZoneNames, drawZones, shownOf, type Shown } from "../draw/loci";
import { drawLoads, drawNames, drawSketch, drawSprings, placesOf } from "../draw/mechanism";
import { curveAt } from "../draw/pick";
import { Layer } from "../draw/surface";
import { fit, moved, zoomed, type Box, type Size, type View } from "../draw/view";
import { unitOf } from "../data/units";
import { zonesKey } from "./legend";
import { themeOf, type LociView, type Settings } from "./view";

export class CurvesView implements LociView {
  readonly element = h("div", { class: "viewer-stage", tabindex: 0, "aria-label": "Loci; + and - zoom, arrow keys move, 0 shows all" });
  readonly hint = "Wheel: zoom. Drag: move. Double click: show all. Point at a curve to see which reactions vanish there.";
  private readonly layer: Layer;
  private view: View | undefined;
  private size: Size = { width: 0, height: 0 };
  private shown: Shown = { curves: [], points: [], rings: [] };
  private lit: Curve | undefined;
  private held: Point | undefined;

  constructor(private readonly settings: Settings, private readonly reading: HTMLElement) {
    this.layer = new Layer(this.element, "loci");
    new ResizeObserver(() => {
      this.size = { width: this.element.clientWidth, height: this.element.clientHeight };
      this.layer.resize(this.size);
      this.showAll();
    }).observe(this.element);
    const place = (event: MouseEvent): Point => {
      const box = this.element.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    this.element.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.change(this.view && zoomed(this.view, place(event), Math.exp(-event.deltaY * 0.0015)));
    }, { passive: false });
    this.element.addEventListener("pointerdown", (event) => {
      this.held = place(event);
      this.element.setPointerCapture(event.pointerId);
    });
    this.element.addEventListener("pointerup", () => (this.held = undefined));
    this.element.addEventListener("dblclick", () => this.showAll());
    this.element.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (this.held && this.view) {
        const by: Point = [at[0] - this.held[0], at[1] - this.held[1]];
        this.held = at;
        this.change(moved(this.view, by));
      } else this.point(at);
    });
    this.element.addEventListener("keydown", (event) => this.key(event));
  }

  private get angles(): [boolean, boolean] {
    const { units } = this.settings.data.loci;
    return [units?.[0] === "rad", units?.[1] === "rad"];
  }

  private get sketch(): Sketch | undefined {
    const { data, mode } = this.settings;
    return data.sketches.find((one) => mode && sameMode(one.working_mode, mode))?.sketch;
  }

  private showAll(): void {
    const [x, y] = this.settings.data.loci.box;
    if (!x || !y || this.size.width === 0) return;
    const box: Box = { low: [x[0], y[0]], high: [x[1], y[1]] };
    // With the mechanism, where that does not make the loci small.
    const places = this.sketch ? placesOf(this.sketch) : [];
    const low: Point = [Math.min(box.low[0], ...places.map((at) => at[0])), Math.min(box.low[1], ...places.map((at) => at[1]))];
    const high: Point = [Math.max(box.high[0], ...places.map((at) => at[0])), Math.max(box.high[1], ...places.map((at) => at[1]))];
    const growth = Math.max(high[0] - low[0], high[1] - low[1]) / Math.max(x[1] - x[0], y[1] - y[0]);
    if (growth <= 3) Object.assign(box, { low, high });
    this.change(fit(box, this.size, !this.angles.some(Boolean)));
  }

  private change(view: View | undefined): void {
    this.view = view;
    this.draw();
  }

  private point(at: Point): void {
    const now = this.view && curveAt(this.shown, this.view, at);
    if (now === this.lit) return;
    this.lit = now;
    replace(this.reading, now ? readingOf(this.settings.data.rules, now) : undefined);
    this.draw();
  }

  private key(event: KeyboardEvent): void {
    const way: Record<string, Point> = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
    const along = way[event.key];
    const middle: Point = [this.size.width / 2, this.size.height / 2];
    if (!this.view) return;
    if (along) {
      event.preventDefault();
      this.change(moved(this.view, along));
    } else if (event.key === "+" || event.key === "=") this.change(zoomed(this.view, middle, 1.25));
    else if (event.key === "-") this.change(zoomed(this.view, middle, 0.8));
    else if (event.key === "0") this.showAll();
  }

  draw(): void {
    const { data, hidden, mode } = this.settings;
    const theme = themeOf(this.settings);
    const context = this.layer.begin();
    this.shown = shownOf(data, mode, hidden);
    const { view } = this;
    const [x, y] = data.loci.box;
    if (!view || !x || !y) return;
    const [first, second] = data.loci.coordinates;
    drawWorkspace(context, view, this.shown.rings, theme);
    const zones = hidden.has(zonesKey) ? [] : data.zones.filter((one) => !mode || sameMode(one.working_mode, mode));
    drawZones(context, view, zones, theme, false);
    drawGrid(context, view, this.size, { names: [first ?? "x", second ?? "y"], units: [unitOf(data.units, this.angles[0]), unitOf(data.units, this.angles[1])] }, theme);
    drawBox(context, view, { low: [x[0], y[0]], high: [x[1], y[1]] }, theme);
    const { sketch } = this;
    if (sketch) drawSketch(context, view, sketch, theme);
    drawCurves(context, view, this.shown, theme, { strength: 1, highlight: this.lit?.id });
    drawPoints(context, view, this.shown, theme);
    drawZoneNames(context, view, zones, theme);
    if (sketch) {
      drawSprings(context, view, sketch, theme);
      drawLoads(context, view, sketch, theme);
      drawNames(context, view, sketch, theme);
    }
  }
}
