// The plane on which one designs: loci and zones below, the mechanism and the task above, all of it moved by hand.
import type { Curve, Point, Sketch } from "../data/answers";
import { roundText } from "../data/exact";
import { unitOf } from "../data/units";
import { slotOf, type ValuePath } from "../data/file_text";
import { drawBox, drawGrid, type AxisNames } from "../draw/axes";
import { drawCurves, drawPoints, drawWorkspace, drawZoneNames, drawZones, shownOf, type Shown } from "../draw/loci";
import { boxAround, drawLoads, drawNames, drawReactions, drawSketch, drawSprings, drawTakeUp, placesOf, reactionArrows } from "../draw/mechanism";
import { crossed, curveAt, zoneAt } from "../draw/pick";
import { Layer } from "../draw/surface";
import { fit, moved, page, plane, zoomed, type Box, type Size, type View } from "../draw/view";
import { h } from "./dom";
import { crossingWords, drawFlash, drawPath, drawPoseCross, drawTask, drawWitness } from "./stage_drawing";
import { Pull } from "./pull";
import { noDemands } from "./state";
import { drawnShape, handles, movedShape, taskHit, withHandle, type DrawnKind } from "./task_text";
import { nearestOnWay } from "./way";
import type { Workbench } from "./workbench";

type Grip =
  | { kind: "pose" }
  | { kind: "base" | "joint"; name: string }
  | { kind: "handle"; index: number }
  | { kind: "task"; from: Point }
  | { kind: "drawing"; from: Point }
  | { kind: "view"; from: Point };

export class Stage {
  readonly element = h("div", {
    class: "stage",
    tabindex: 0,
    role: "application",
    "aria-label": "The mechanism over its loci. Arrow keys move the end effector, with Shift in small steps; + and - zoom, 0 shows all.",
  });
  /** What the pointer is on. */
  hovered: { curve?: Curve; zone?: string; at: Point } | undefined;
  onHover: () => void = () => undefined;
  private readonly ground: Layer;
  private readonly top: Layer;
  private view: View | undefined;
  private size: Size = { width: 0, height: 0 };
  private grip: Grip | undefined;
  private shown: Shown = { curves: [], points: [], rings: [] };
  private fitted = "";
  /** The kind of task that the next drag on the empty plane draws. */
  private armed: DrawnKind | undefined;
  onArmed: (kind: DrawnKind | undefined) => void = () => undefined;
  private flash: { curves: Curve[]; until: number } | undefined;

  private readonly pull: Pull;

  constructor(private readonly bench: Workbench) {
    this.pull = new Pull(bench);
    this.ground = new Layer(this.element, "loci");
    this.top = new Layer(this.element, "mechanism");
    new ResizeObserver(() => this.resize()).observe(this.element);
    this.element.addEventListener("pointerdown", (event) => this.press(event));
    this.element.addEventListener("pointermove", (event) => this.move(event));
    this.element.addEventListener("pointerup", () => this.release());
    this.element.addEventListener("pointercancel", () => this.release());
    this.element.addEventListener("pointerleave", () => this.leave());
    this.element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.element.addEventListener("dblclick", () => this.showAll());
    this.element.addEventListener("keydown", (event) => this.key(event));
    bench.watch((news) => this.onNews(news));
  }

  private get active(): boolean {
    return this.bench.coordinates.length <= 2;
  }
  private get cycle(): boolean {
    return this.bench.coordinates.length === 1;
  }
  private get sketch(): Sketch | undefined {
    return this.bench.inPlace || this.cycle ? this.bench.pose?.sketch : undefined;
  }

  private onNews(news: Set<string>): void {
    if (!this.active) {
      this.ground.begin();
      this.top.begin();
      return;
    }
    if (news.has("loci") || news.has("state.hidden")) {
      const { picture, state } = this.bench;
      if (picture) this.shown = shownOf(picture, undefined, new Set(state.hidden));
    }
    const any = (...names: string[]): boolean => names.some((one) => news.has(one));
    const seen = this.view;
    if (any("loci", "zones", "kept", "theme", "kind", "sweep", "state.file", "state.hidden", "state.zones") || (news.has("pose") && this.fitted !== this.mark)) this.drawGround();
    if (this.view !== seen || any("pose", "verify", "theme", "kind", "sweep", "fault", "state.file", "state.at", "state.task", "state.reactions", "state.takeUp")) this.drawTop();
  }

  // ---- Looking

  private get box(): Box | undefined {
    if (this.cycle) return this.cycleBox();
    const box = this.bench.picture?.loci.box;
    const [x, y] = box ?? [];
    if (!x || !y) return undefined;
    return boxAround([[x[0], y[0]], [x[1], y[1]], ...(this.sketch ? placesOf(this.sketch) : [])]);
  }

  private cycleBox(): Box | undefined {
    const places = (this.bench.sweep?.answer.places ?? []).flatMap((at) => (at ? [[at[0] ?? 0, at[1] ?? 0] as Point] : []));
    return boxAround([...places, ...(this.bench.pose?.sketch ? placesOf(this.bench.pose.sketch) : [])]);
  }

  private get angles(): [boolean, boolean] {
    if (this.cycle) return [false, false];
    return [this.bench.coordinates[0]?.angle ?? false, this.bench.coordinates[1]?.angle ?? false];
  }

  showAll(): void {
    const box = this.box;
    if (!box || this.size.width === 0) return;
    this.view = fit(box, this.size, !this.angles.some(Boolean), this.cycle ? 60 : 34);
    this.drawGround();
    this.drawTop();
  }

  private resize(): void {
    this.size = { width: this.element.clientWidth, height: this.element.clientHeight };
    this.ground.resize(this.size);
    this.top.resize(this.size);
    this.fitted = "";
    this.drawGround();
    this.drawTop();
  }

  /** Of what is to be shown whole. */
  private get mark(): string {
    return `${this.bench.state.file}|${this.bench.coordinates.length}|${this.size.width}x${this.size.height}`;
  }

  /** A new mechanism is shown whole; while one designs, the view stays. */
  private prepare(): View | undefined {
    const { mark } = this;
    const box = this.box;
    if (box && this.size.width > 0 && (this.fitted !== mark || !this.view)) {
      this.view = fit(box, this.size, !this.angles.some(Boolean), this.cycle ? 60 : 34);
      const whole = this.cycle ? this.bench.pose && this.bench.sweep : this.bench.pose ?? !this.bench.inPlace;
      if (whole) this.fitted = mark;
    }
    return this.view;
  }

  private drawGround(): void {
    const context = this.ground.begin();
    const view = this.prepare();
    this.element.dataset["view"] = JSON.stringify(view ?? null);
    const { bench } = this;
    if (!view || !bench.picture || !this.active) return;
    const theme = bench.theme;
    const names = bench.picture.loci.coordinates;
    const axes: AxisNames = {
      names: this.cycle ? ["x", "y"] : [names[0] ?? "x", names[1] ?? "y"],
      units: [unitOf(bench.units, this.angles[0]), unitOf(bench.units, this.angles[1])],
    };
    if (this.cycle) {
      drawGrid(context, view, this.size, axes, theme);
      if (bench.sweep) drawPath(context, view, bench, theme);
      return;
    }
    drawWorkspace(context, view, this.shown.rings, theme);
    const zones = bench.state.zones ? bench.zones?.zones ?? [] : [];
    drawZones(context, view, zones, theme, bench.zonesStale);
    drawGrid(context, view, this.size, axes, theme);
    const [x, y] = bench.picture.loci.box;
    if (x && y) drawBox(context, view, { low: [x[0], y[0]], high: [x[1], y[1]] }, theme);
    if (bench.kept) drawCurves(context, view, shownOf(bench.kept, undefined, new Set(bench.state.hidden)), theme, { strength: 0.28 });
    drawCurves(context, view, this.shown, theme, { strength: 1, highlight: this.hovered?.curve?.id, proven: bench.proven });
    drawPoints(context, view, this.shown, theme);
    if (!bench.zonesStale) drawZoneNames(context, view, zones, theme);
  }

  private drawTop(): void {
    const context = this.top.begin();
    const { view, bench } = this;
    if (!view || !this.active) return;
    this.tellMagnification();
    const { theme, state, pose } = bench;
    if (state.task && !this.cycle) drawTask(context, view, state.task, bench.verdict, theme, bench.model.metres);
    const sketch = this.sketch;
    if (sketch) {
      context.globalAlpha = bench.poseFault ? 0.45 : 1;
      drawSketch(context, view, sketch, theme);
      context.globalAlpha = 1;
      drawSprings(context, view, sketch, theme);
      drawLoads(context, view, sketch, theme);
      if (pose && state.reactions) drawReactions(context, view, sketch, reactionArrows(pose), theme);
      if (pose && state.takeUp) drawTakeUp(context, view, sketch, pose, this.magnification, theme);
      drawNames(context, view, sketch, theme);
    } else if (state.at && !this.cycle) {
      drawPoseCross(context, page(view, [state.at[0] ?? 0, state.at[1] ?? 0]), theme);
    }
    if (bench.verdict && state.task && !this.cycle) drawWitness(context, view, bench.verdict, theme);
    if (this.flash && performance.now() < this.flash.until) {
      drawFlash(context, view, this.flash.curves, theme, (this.flash.until - performance.now()) / flashTime);
      requestAnimationFrame(() => this.drawTop());
    }
  }

  /** Take-up is some micrometres: drawn so that the largest is some pixels. */
  get magnification(): number {
    const sizes = Object.values(this.bench.pose?.take_up ?? {}).map((own) => Math.hypot(own.dx ?? 0, own.dy ?? 0));
    const largest = Math.max(0, ...sizes) * (this.view?.scale[0] ?? 1);
    return largest > 0 ? 10 ** Math.floor(Math.log10(14 / largest)) : 1;
  }

  private told = 0;
  private tellMagnification(): void {
    if (this.told === this.magnification) return;
    this.told = this.magnification;
    this.bench.tell("view");
  }

  // ---- Moving

  private place(event: PointerEvent | WheelEvent): Point {
    const box = this.element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** What of the mechanism or the task a press at this place takes hold of. */
  private gripAt(at: Point): Grip | undefined {
    const { view, bench } = this;
    if (!view) return undefined;
    const near = (place: Point, reach: number): boolean => {
      const there = page(view, place);
      return Math.hypot(there[0] - at[0], there[1] - at[1]) <= reach;
    };
    const { task, at: pose } = bench.state;
    if (task && !this.cycle) {
      const index = handles(task.shape).findIndex((handle) => near(handle, 9));
      if (index >= 0) return { kind: "handle", index };
    }
    if (this.cycle) {
      const end = this.endPlace;
      if (end && near(end, 22)) return { kind: "pose" };
    } else if (pose && near([pose[0] ?? 0, pose[1] ?? 0], 16)) return { kind: "pose" };
    if (this.sketch) {
      const base = bench.model.basePoints.find((point) => {
        const place = bench.pose?.posture[point.name];
        return place && near([place[0] ?? 0, place[1] ?? 0], 13) && this.draggable(point.path);
      });
      if (base) return { kind: "base", name: base.name };
    }
    if (this.sketch) {
      const moving = bench.facts?.links.flatMap((link) => link.points).find((name) => {
        const place = bench.pose?.posture[name];
        return place && near([place[0] ?? 0, place[1] ?? 0], 11) && !bench.model.basePoints.some((one) => one.name === name);
      });
      if (moving !== undefined) return { kind: "joint", name: moving };
    }
    if (task && !this.cycle && taskHit(task.shape, plane(view, at), 8 / view.scale[0])) return { kind: "task", from: plane(view, at) };
    return undefined;
  }

  private get endPlace(): Point | undefined {
    const place = this.bench.pose?.posture[this.bench.facts?.end_effector.at ?? ""];
    return place ? [place[0] ?? 0, place[1] ?? 0] : undefined;
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0) return;
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    const at = this.place(event);
    this.grip = this.gripAt(at) ?? (this.armed && this.view ? { kind: "drawing", from: plane(this.view, at) } : { kind: "view", from: at });
    this.element.dataset["grip"] = this.grip.kind;
  }

  private move(event: PointerEvent): void {
    const at = this.place(event);
    if (!this.view) return;
    if (!this.grip) return this.hover(at);
    const to = plane(this.view, at);
    switch (this.grip.kind) {
      case "view":
        this.view = moved(this.view, [at[0] - this.grip.from[0], at[1] - this.grip.from[1]]);
        this.grip.from = at;
        this.drawGround();
        return this.drawTop();
      case "pose":
        return this.cycle ? this.dragAlongCycle(to) : this.movePose([this.onGrid(to[0]), this.onGrid(to[1])], "drag-pose");
      case "base":
        return this.dragBase(this.grip.name, to);
      case "joint":
        return this.pull.towards(this.grip.name, to);
      case "drawing":
        return this.drawTask(this.grip.from, to);
      case "handle":
        return this.changeTask((shape) => withHandle(shape, (this.grip as { index: number }).index, [this.onGrid(to[0]), this.onGrid(to[1])]));
      case "task": {
        const by: Point = [this.onGrid(to[0] - this.grip.from[0]), this.onGrid(to[1] - this.grip.from[1])];
        if (by[0] === 0 && by[1] === 0) return;
        this.grip.from = [this.grip.from[0] + by[0], this.grip.from[1] + by[1]];
        return this.changeTask((shape) => movedShape(shape, by));
      }
    }
  }

  /** Round decimals no coarser than a pixel. */
  private onGrid(value: number): number {
    const { metres } = this.bench.model; // round in the file's unit
    return Number((Number(roundText(value / metres, 1 / metres / (this.view?.scale[0] ?? 1))) * metres).toPrecision(12));
  }

  /** The next drag on the empty plane draws a task of this kind; none: it moves the plane again. */
  arm(kind: DrawnKind | undefined): void {
    this.armed = kind;
    if (kind) this.element.dataset["tool"] = kind;
    else delete this.element.dataset["tool"];
    this.onArmed(kind);
  }

  private drawTask(from: Point, to: Point): void {
    const { armed, bench } = this;
    if (!armed) return;
    const corner = (at: Point): Point => [this.onGrid(at[0]), this.onGrid(at[1])];
    const shape = drawnShape(armed, corner(from), corner(to));
    if (shape) bench.change({ task: { ...noDemands, ...bench.state.task, shape } }, "draw-task");
  }

  private changeTask(change: (shape: import("./state").TaskShape) => import("./state").TaskShape): void {
    const { task } = this.bench.state;
    if (task) this.bench.change({ task: { ...task, shape: change(task.shape) } }, "drag-task");
  }

  movePose(to: number[], gesture: string): void {
    const from = this.bench.state.at;
    if (from && to.length === 2) {
      const curves = crossed(this.shown, [from[0] ?? 0, from[1] ?? 0], [to[0] ?? 0, to[1] ?? 0]).filter((one) => one.kind !== "workspace-boundary");
      if (curves.length > 0) {
        this.flash = { curves, until: performance.now() + flashTime };
        this.element.dataset["crossed"] = crossingWords(curves);
      }
    }
    this.bench.change({ at: to }, gesture);
  }

  private dragAlongCycle(to: Point): void {
    const value = nearestOnWay(this.bench.sweep?.coordinate ?? [], this.bench.sweep?.answer.places ?? [], to);
    if (value !== undefined) this.bench.change({ at: [value] }, "drag-pose");
  }

  /** Where the coordinates of a point on the ground can be written: a number, or a parameter that stands alone. */
  private slots(path: ValuePath): (ValuePath | undefined)[] {
    return [0, 1].map((axis) => slotOf(this.bench.state.text, [...path, axis]));
  }

  private draggable(path: ValuePath): boolean {
    return this.slots(path).some((slot) => slot !== undefined);
  }

  private dragBase(name: string, to: Point): void {
    const { bench } = this;
    const point = bench.model.basePoints.find((one) => one.name === name);
    const metres = bench.model.metres;
    if (!point) return;
    let model = bench.model;
    this.slots(point.path).forEach((slot, axis) => {
      if (slot) model = model.write(slot, roundText(to[axis as 0 | 1] / metres, 1 / metres / (this.view?.scale[0] ?? 1)));
    });
    if (model.text !== bench.state.text) bench.change({ text: model.text }, `drag-${name}`, `points/${name}/0`);
  }

  private release(): void {
    if (this.grip?.kind === "drawing") this.arm(undefined);
    this.grip = undefined;
    delete this.element.dataset["grip"];
    this.bench.history.endGesture();
  }

  private hover(at: Point): void {
    if (!this.view) return;
    const curve = this.cycle ? undefined : curveAt(this.shown, this.view, at);
    const there = plane(this.view, at);
    const zone = this.bench.state.zones ? zoneAt(this.bench.zones?.zones ?? [], there) : undefined;
    const before = this.hovered?.curve?.id;
    this.hovered = { ...(curve ? { curve } : {}), ...(zone ? { zone: zone.id } : {}), at: there };
    this.element.style.cursor = this.gripAt(at) ? "grab" : curve ? "help" : "default";
    if (before !== curve?.id) this.drawGround();
    this.onHover();
  }

  private leave(): void {
    if (this.grip) return;
    const lit = this.hovered?.curve !== undefined;
    this.hovered = undefined;
    if (lit) this.drawGround();
    this.onHover();
  }

  private wheel(event: WheelEvent): void {
    if (!this.view) return;
    event.preventDefault();
    this.zoom(this.place(event), Math.exp(-event.deltaY * 0.0015));
  }

  private zoom(at: Point, factor: number): void {
    if (!this.view) return;
    this.view = zoomed(this.view, at, factor);
    this.drawGround();
    this.drawTop();
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const middle: Point = [this.size.width / 2, this.size.height / 2];
    const along = way[event.key];
    if (along) {
      event.preventDefault();
      this.step(along, event.shiftKey ? 0.001 : 0.01);
    } else if (event.key === "Escape") this.arm(undefined);
    else if (event.key === "+" || event.key === "=") this.zoom(middle, 1.25);
    else if (event.key === "-") this.zoom(middle, 0.8);
    else if (event.key === "0") this.showAll();
  }

  private step(way: Point, part: number): void {
    const { at } = this.bench.state;
    if (!at) return;
    const to = this.bench.coordinates.map((coordinate, k) => {
      const along = this.cycle ? way[0] + way[1] : way[k as 0 | 1];
      const by = along * part * (coordinate.upper - coordinate.lower);
      return along === 0 ? at[k] ?? 0 : Number(((at[k] ?? 0) + by).toPrecision(12));
    });
    this.movePose(to, "key-pose");
    if (!this.cycle) this.keepInView([to[0] ?? 0, to[1] ?? 0]);
  }

  /** Moves the plane as little as needed, so that a point that no hand holds is seen. */
  private keepInView(at: Point): void {
    if (!this.view) return;
    const margin = 40; // pixels
    const place = page(this.view, at);
    const by = ([this.size.width, this.size.height] as const).map((size, k) => {
      const own = place[k as 0 | 1];
      return Math.max(margin - own, 0) + Math.min(size - margin - own, 0);
    });
    if (by[0] === 0 && by[1] === 0) return;
    this.view = moved(this.view, [by[0] ?? 0, by[1] ?? 0]);
    this.drawGround();
    this.drawTop();
  }
}

const flashTime = 1500; // ms, long enough to read what vanishes
