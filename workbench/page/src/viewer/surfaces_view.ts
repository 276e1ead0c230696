// Loci over three coordinates: surfaces turned by the hand, with a plane to slice them.
import { h, replace } from "../app/dom";
import { readingOf } from "../app/reading";
import { sameMode, type ModeNames } from "../data/answers";
import { axesIn } from "../space/axes";
import { Space, type Slice } from "../space/scene";
import { themeOf, type LociView, type Settings } from "./view";

export class SurfacesView implements LociView {
  readonly element = h("div", { class: "viewer-stage", tabindex: 0, "aria-label": "Surfaces; arrow keys turn them, + and - zoom" });
  readonly hint = "Drag: turn. Wheel: zoom. Point at a surface to see which reactions vanish there.";
  private readonly space: Space | undefined;
  private readonly slice: Slice = { axis: 2, at: 0, on: false };

  constructor(private readonly settings: Settings, private readonly reading: HTMLElement) {
    try {
      this.space = new Space(this.element);
    } catch {
      this.space = undefined;
      this.element.append(h("p", { class: "fault" }, "This browser has no WebGL, which is needed to draw surfaces."));
    }
    this.element.append(this.controls());
    new ResizeObserver(() => this.space?.resize(this.element.clientWidth, this.element.clientHeight)).observe(this.element);
    this.element.addEventListener("pointermove", (event) => {
      if (event.buttons !== 0) return;
      const box = this.element.getBoundingClientRect();
      const id = this.space?.at((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
      const surface = settings.data.loci.surfaces?.find((one) => one.id === id);
      replace(this.reading, surface ? readingOf(settings.data.rules, surface) : undefined);
    });
    this.element.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
      if (way) this.space?.turn(way[0] ?? 0, way[1] ?? 0);
      else if (event.key === "+" || event.key === "=") this.space?.zoom(1.2);
      else if (event.key === "-") this.space?.zoom(1 / 1.2);
    });
  }

  private controls(): HTMLElement {
    const { coordinates, box } = this.settings.data.loci;
    const on = h("input", { type: "checkbox" });
    const axis = h("select", { "aria-label": "Slice across" }, ...coordinates.map((name, k) => h("option", { value: k }, name)));
    const slider = h("input", { type: "range", min: 0, max: 1, step: "any", value: 0.5, "aria-label": "Place of the slice" });
    axis.value = "2";
    const change = (): void => {
      const range = box[Number(axis.value)] ?? [0, 1];
      Object.assign(this.slice, { axis: Number(axis.value), on: on.checked, at: range[0] + Number(slider.value) * (range[1] - range[0]) });
      this.draw();
    };
    on.addEventListener("change", change);
    axis.addEventListener("change", change);
    slider.addEventListener("input", () => {
      on.checked = true;
      change();
    });
    return h("div", { class: "slice viewer-slice" }, h("label", { class: "tick" }, on, "slice"), axis, slider);
  }

  draw(): void {
    const { data, hidden, mode } = this.settings;
    const here = (one: { working_mode: ModeNames }): boolean => !mode || sameMode(one.working_mode, mode);
    const own = new Set([...(data.loci.surfaces ?? []), ...data.loci.curves].filter(here).map((one) => one.id));
    const ofMode = (index: number): boolean => { const point = data.loci.isolated_points[index]; return point !== undefined && here(point); };
    const groups = data.surface_groups.map((group) => ({ ...group, ids: group.ids.filter((id) => own.has(id)), points: group.points.filter(ofMode) }));
    const { coordinates, box, units } = data.loci;
    const axes = axesIn(data.units, coordinates.map((name, k) => ({ name, lower: box[k]?.[0] ?? 0, upper: box[k]?.[1] ?? 1, angle: units?.[k] === "rad" })));
    this.space?.show({ ...data, surface_groups: groups }, themeOf(this.settings), hidden, this.slice, axes);
  }
}
