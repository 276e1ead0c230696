// The sheet on which a mechanism is drawn: its loci below as soon as there are any, the mechanism above, tools in the hand.
import type { Point } from "../data/answers";
import { unitOf } from "../data/units";
import { drawGrid } from "../draw/axes";
import { drawCurves, drawPoints, drawWorkspace, drawZones, shownOf } from "../draw/loci";
import { boxAround, drawArrow, drawSketch } from "../draw/mechanism";
import { Layer } from "../draw/surface";
import { fit, moved, page, plane, zoomed, type Size, type View } from "../draw/view";
import { isWhole, type Drawing } from "../drawing/drawing";
import type { Spot } from "../drawing/edit";
import { elementOf, isThere, type Element } from "../drawing/element";
import { arrowScale, elementAt, gripAt, type Grip } from "../drawing/grips";
import { drawDrawing, extentOf } from "../drawing/picture";
import { removeElement } from "../drawing/remove";
import { gridStep, linksAt, snap, type Snapping } from "../drawing/snap";
import { tools } from "../drawing/tools/list";
import { moveGrip, selectTool } from "../drawing/tools/select";
import { forceOf, type Hand, type Tool } from "../drawing/tools/tool";
import { h } from "./dom";
import { Pull } from "./pull";
import { drawPath } from "./stage_drawing";
import type { Workbench } from "./workbench";

type Hold = { kind: "view"; from: Point } | { kind: "grip"; grip: Grip; from: Spot; element: Element | undefined; moved: boolean } | { kind: "way"; pressed: Point };

export class DrawingStage {
  readonly canvas = h("div", {
    class: "sheet",
    tabindex: 0,
    role: "application",
    "aria-label": "The sheet. The letters in the toolbar choose tools, Delete removes what is selected, arrow keys move it; + and - zoom, 0 shows all.",
  });
  tool: Tool = selectTool;
  selected: Element | undefined;
  readonly snapping: Snapping = { grid: true, lengths: false };
  onTool: () => void = () => undefined;
  /** What stands beside the drawing follows it. */
  readonly followers: (() => void)[] = [];
  private readonly ground: Layer;
  private readonly top: Layer;
  private size: Size = { width: 0, height: 0 };
  view: View = { scale: [1000, 1000], origin: [0, 0] };
  private fitted = "";
  private hold: Hold | undefined;
  /** Where a way began, and what lay there. */
  private begun: { spot: Spot; element: Element | undefined; under: string[] } | undefined;
  private pointer: Spot | undefined;
  /** Pixels a newton while an arrow is held. */
  private arrow: number | undefined;

  private readonly pull: Pull;

  constructor(private readonly bench: Workbench) {
    this.pull = new Pull(bench);
    this.ground = new Layer(this.canvas, "sheet-loci");
    this.top = new Layer(this.canvas, "sheet");
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.canvas.addEventListener("pointerdown", (event) => this.press(event));
    this.canvas.addEventListener("pointermove", (event) => this.move(event));
    this.canvas.addEventListener("pointerup", (event) => this.release(event));
    this.canvas.addEventListener("pointercancel", () => this.letGo());
    this.canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    bench.watch((news) => this.onNews(news));
  }

  private get drawing(): Drawing {
    return this.bench.drawing;
  }
  private get pixel(): number {
    return 1 / this.view.scale[0];
  }
  /** What the program or the drawing itself finds fault with. */
  get wrong(): Element | undefined {
    const { missing, fault } = this.bench;
    const element = missing ? missing.element : fault && elementOf(fault.path);
    return element && isThere(this.drawing, element) ? element : undefined;
  }

  take(tool: Tool): void {
    this.tool = tool;
    this.begun = undefined;
    if (tool.takes === "grip") delete this.canvas.dataset["tool"];
    else {
      this.canvas.dataset["tool"] = tool.id;
      this.select(undefined);
    }
    this.onTool();
    this.drawTop();
  }

  select(element: Element | undefined): void {
    this.selected = element;
    this.drawTop();
  }

  // ---- Looking

  private onNews(news: Set<string>): void {
    if (!this.bench.state.drawing) {
      this.fitted = "";
      return;
    }
    if (news.has("state.text") || news.has("state.file")) {
      if (this.selected && !isThere(this.drawing, this.selected)) this.select(undefined);
      if (this.begun?.spot.point !== undefined && !isThere(this.drawing, { kind: "point", name: this.begun.spot.point })) this.begun = undefined;
    }
    if (this.fitted !== this.mark) this.showAll();
    else this.draw();
  }

  /** Of what is shown whole once; while one draws the view stays. */
  private get mark(): string {
    return this.size.width > 0 ? `${this.bench.state.file}|${this.bench.state.drawing}` : "";
  }

  showAll(): void {
    if (this.size.width === 0) return;
    const margin = Math.min(90, this.size.width / 6);
    const box = boxAround(extentOf(this.drawing));
    const scale = 1 / (this.bench.units.length.size > 0.5 ? 1e-3 : this.bench.units.length.size); // a unit, or a mm, is a pixel
    this.view = box && (box.high[0] > box.low[0] || box.high[1] > box.low[1])
      ? fit(box, this.size, true, margin)
      : { scale: [scale, scale], origin: [Math.round(this.size.width * 0.35), Math.round(this.size.height * 0.7)] };
    this.fitted = this.mark;
    this.draw();
  }

  private resize(): void {
    this.size = { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
    this.ground.resize(this.size);
    this.top.resize(this.size);
    if (!this.bench.state.drawing) return;
    if (this.fitted !== this.mark) this.showAll();
    else this.draw();
  }

  private draw(): void {
    this.drawGround();
    this.drawTop();
  }

  private drawGround(): void {
    const context = this.ground.begin();
    const { bench, view } = this;
    this.canvas.dataset["view"] = JSON.stringify(view);
    const { theme, picture } = bench;
    const fine = gridStep(this.drawing, this.pixel) * this.drawing.metres * view.scale[0];
    if (this.snapping.grid && fine >= 8) drawDots(context, view, this.size, fine, theme.grid);
    const shown = picture && bench.inPlace ? shownOf(picture, undefined, new Set(bench.state.hidden)) : undefined;
    if (shown) {
      drawWorkspace(context, view, shown.rings, theme);
      if (bench.state.zones) drawZones(context, view, bench.zones?.zones ?? [], theme, bench.zonesStale);
    }
    drawGrid(context, view, this.size, { names: ["x", "y"], units: [unitOf(bench.units, false), unitOf(bench.units, false)] }, theme);
    if (shown) {
      drawCurves(context, view, shown, theme, { strength: 1, highlight: undefined });
      drawPoints(context, view, shown, theme);
    }
    if (picture && bench.coordinates.length === 1) drawPath(context, view, bench, theme);
  }

  private drawTop(): void {
    const context = this.top.begin();
    const { bench, view, drawing } = this;
    const { theme } = bench;
    const sketch = bench.pose?.sketch;
    if (sketch && bench.playing) return drawSketch(context, view, sketch, theme);
    if (sketch && !isWhole(drawing)) drawSketch(context, view, sketch, theme);
    else if (sketch && this.closesElsewhere()) {
      context.globalAlpha = 0.45;
      drawSketch(context, view, sketch, theme);
      context.globalAlpha = 1;
    }
    drawDrawing(context, view, drawing, theme, { selected: this.selected, wrong: this.wrong, arrow: this.arrow ?? arrowScale(drawing) });
    this.drawPreview(context);
    this.canvas.dataset["points"] = JSON.stringify(Object.fromEntries(drawing.points.map((one) => [one.name, one.at])));
    this.followers.forEach((follow) => follow());
  }

  /** Whether the program closes the drawing in another place than it is drawn: given lengths beat it, or it moves. */
  private closesElsewhere(): boolean {
    const posture = this.bench.pose?.posture ?? {};
    return !this.bench.missing && !this.bench.poseFault && this.drawing.points.some((one) => {
      const [x, y] = posture[one.name] ?? [];
      return one.section === "drawn" && one.at && x !== undefined && y !== undefined && Math.hypot(x - one.at[0], y - one.at[1]) > this.pixel;
    });
  }

  private drawPreview(context: CanvasRenderingContext2D): void {
    const { pointer, begun, tool, view } = this;
    if (!pointer || tool.takes === "grip") return;
    const { theme } = this.bench;
    const to = page(view, pointer.at);
    context.save();
    context.strokeStyle = context.fillStyle = theme.load;
    context.lineWidth = 2;
    context.beginPath();
    context.arc(to[0], to[1], pointer.point === undefined ? 3 : 9, 0, 2 * Math.PI);
    context.stroke();
    context.font = "11px system-ui, sans-serif";
    let told = `${pointer.texts[0]}, ${pointer.texts[1]}`;
    if (begun) {
      const from = page(view, begun.spot.at);
      context.setLineDash([5, 4]);
      context.beginPath();
      if (tool.preview === "box") context.strokeRect(Math.min(from[0], to[0]), Math.min(from[1], to[1]), Math.abs(to[0] - from[0]), Math.abs(to[1] - from[1]));
      else if (tool.preview === "arrow") {
        drawArrow(context, from, to, theme.load);
        const force = forceOf(this.hand(pointer), begun.spot.at, pointer.at);
        told = `${force[0]}, ${force[1]} ${this.bench.units.force.name}`;
      } else {
        context.moveTo(...from);
        context.lineTo(...to);
        context.stroke();
        const way = Math.hypot(pointer.at[0] - begun.spot.at[0], pointer.at[1] - begun.spot.at[1]) / this.drawing.metres;
        told = `${told} — ${pointer.length ?? Number(way.toPrecision(5))}`;
      }
    }
    context.setLineDash([]);
    context.fillStyle = theme.ink;
    context.fillText(told, Math.min(to[0] + 12, this.size.width - 110), Math.max(to[1] - 12, 14));
    context.restore();
  }

  // ---- The hand

  private place(event: PointerEvent | WheelEvent): Point {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private spotAt(at: Point, except?: string): Spot {
    return snap(this.drawing, plane(this.view, at), this.pixel, this.tool.preview === "arrow" && this.begun ? { grid: false, lengths: false } : this.snapping, this.begun?.spot.at, except);
  }

  private hand(to: Spot): Hand {
    const { begun, drawing, pixel } = this;
    const at = to.at;
    return {
      drawing,
      from: begun?.spot ?? to,
      to,
      element: begun ? begun.element : elementAt(drawing, at, pixel),
      under: begun?.under ?? linksAt(drawing, at, pixel),
      over: linksAt(drawing, at, pixel),
      pixel,
      arrow: 1 / (this.arrow ?? arrowScale(drawing)),
    };
  }

  private press(event: PointerEvent): void {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.place(event);
    const there = plane(this.view, at);
    if (event.button !== 0) {
      this.hold = { kind: "view", from: at };
      return;
    }
    const spot = this.spotAt(at);
    this.pointer = spot;
    if (this.tool.takes === "grip") return this.grip(at, spot);
    const element = elementAt(this.drawing, there, this.pixel);
    const under = linksAt(this.drawing, there, this.pixel);
    if (this.tool.takes === "place") {
      this.apply(this.tool.act({ ...this.hand(spot), element, over: under }));
      return;
    }
    if (this.begun) return this.finish(spot, at);
    this.begun = { spot, element, under };
    this.hold = { kind: "way", pressed: at };
    this.drawTop();
  }

  private grip(at: Point, spot: Spot): void {
    const grip = gripAt(this.drawing, plane(this.view, at), this.pixel);
    const element: Element | undefined = !grip ? undefined : grip.kind === "element" ? grip.element : grip.kind === "arrow" ? { kind: "load", index: grip.index } : grip.kind === "range" ? { kind: "coordinate", name: grip.name } : undefined;
    this.arrow = arrowScale(this.drawing);
    this.hold = grip ? { kind: "grip", grip, from: spot, element, moved: false } : { kind: "view", from: at };
    this.canvas.dataset["grip"] = grip?.kind ?? "view";
    this.select(element);
  }

  private move(event: PointerEvent): void {
    const at = this.place(event);
    const { hold } = this;
    if (hold?.kind === "view") {
      this.view = moved(this.view, [at[0] - hold.from[0], at[1] - hold.from[1]]);
      hold.from = at;
      return this.draw();
    }
    if (hold?.kind === "grip") return this.drag(hold, at);
    this.pointer = this.spotAt(at);
    if (this.tool.takes === "grip") {
      this.canvas.style.cursor = gripAt(this.drawing, plane(this.view, at), this.pixel) ? "grab" : "default";
      return;
    }
    this.drawTop();
  }

  private drag(hold: Extract<Hold, { kind: "grip" }>, at: Point): void {
    const point = hold.element?.kind === "point" && hold.grip.kind === "element" ? hold.element.name : undefined;
    const to = hold.grip.kind === "arrow" ? snap(this.drawing, plane(this.view, at), this.pixel, { grid: false, lengths: false }) : this.spotAt(at, point);
    hold.moved = true;
    // A point is not put onto another one: they would be one.
    const free = point !== undefined && to.point !== undefined ? snap({ ...this.drawing, points: [] }, plane(this.view, at), this.pixel, this.snapping) : to;
    const text = moveGrip(hold.grip, { ...this.hand(free), from: hold.from, element: hold.element });
    if (text !== undefined) this.bench.edit(text, `grip-${JSON.stringify(hold.grip)}`);
    else if (point !== undefined && this.drawing.points.some((one) => one.name === point && !one.fixed)) this.pull.towards(point, plane(this.view, at));
  }

  private release(event: PointerEvent): void {
    const at = this.place(event);
    const { hold } = this;
    this.letGo();
    if (hold?.kind === "way" && Math.hypot(at[0] - hold.pressed[0], at[1] - hold.pressed[1]) > 5) this.finish(this.spotAt(at), at);
    if (event.pointerType === "touch") this.pointer = undefined;
  }

  /** What the hand holds goes where it was. */
  private putBack(): void {
    this.pull.stop();
    this.bench.cancelGesture();
    this.letGo();
  }

  private letGo(): void {
    this.hold = undefined;
    this.arrow = undefined;
    delete this.canvas.dataset["grip"];
    this.bench.history.endGesture();
    this.drawTop();
  }

  private finish(spot: Spot, at: Point): void {
    const over = linksAt(this.drawing, plane(this.view, at), this.pixel);
    const text = this.tool.act({ ...this.hand(spot), over });
    this.begun = undefined;
    this.hold = undefined;
    this.apply(text);
  }

  private apply(text: string | undefined): void {
    if (text === undefined) this.bench.tell("nothing");
    else this.bench.edit(text);
    this.bench.history.endGesture();
    this.pointer = undefined; // until it moves again
    this.drawTop();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.zoom(Math.exp(-event.deltaY * 0.0015), this.place(event));
  }

  zoom(factor: number, at: Point = [this.size.width / 2, this.size.height / 2]): void {
    this.view = zoomed(this.view, at, factor);
    this.draw();
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const along = way[event.key];
    const tool = tools.find((one) => one.key === event.key.toLowerCase());
    if (along) {
      event.preventDefault();
      this.nudge(along);
    } else if (event.key === "Escape") {
      if (this.hold?.kind === "grip") this.putBack();
      else this.take(this.begun ? this.tool : selectTool);
    }
    else if (event.key === "Delete" || event.key === "Backspace") this.removeSelected();
    else if (event.key === "+" || event.key === "=") this.zoom(1.25);
    else if (event.key === "-") this.zoom(0.8);
    else if (event.key === "0") this.showAll();
    else if (tool) this.take(tool);
  }

  removeSelected(): void {
    if (this.selected) this.apply(removeElement(this.drawing, this.selected));
  }

  private nudge(along: Point): void {
    const { selected, drawing } = this;
    const at = selected?.kind === "point" ? drawing.points.find((one) => one.name === selected.name)?.at : undefined;
    if (!selected || !at) return;
    const step = gridStep(drawing, this.pixel) * drawing.metres;
    const to: Point = [at[0] + along[0] * step, at[1] + along[1] * step];
    const texts = to.map((value) => String(Number((value / drawing.metres).toPrecision(10)))) as [string, string];
    const text = selectTool.act({ ...this.hand({ at: to, texts }), element: selected });
    if (text !== undefined) this.bench.edit(text, "nudge");
  }
}

function drawDots(context: CanvasRenderingContext2D, view: View, size: Size, step: number, colour: string): void {
  context.save();
  context.fillStyle = colour;
  const first = (origin: number): number => ((origin % step) + step) % step;
  for (let x = first(view.origin[0]); x < size.width; x += step) for (let y = first(view.origin[1]); y < size.height; y += step) context.fillRect(x - 0.75, y - 0.75, 1.5, 1.5);
  context.restore();
}
