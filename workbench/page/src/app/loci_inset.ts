// The loci beside the sheet, where their plane is not the mechanism's own: a small picture of what is drawn.
import { drawBox } from "../draw/axes";
import { drawCurves, drawPoints, drawWorkspace, shownOf } from "../draw/loci";
import { Layer } from "../draw/surface";
import { fit } from "../draw/view";
import { h } from "./dom";
import type { Workbench } from "./workbench";

const size = { width: 210, height: 170 };

export class LociInset {
  readonly element = h("button", { type: "button", class: "loci-inset", title: "Look at the loci", hidden: true });
  private readonly layer: Layer;
  private readonly words = h("span", {});

  constructor(private readonly bench: Workbench) {
    this.layer = new Layer(this.element, "loci-inset");
    this.element.append(this.words);
    this.element.addEventListener("click", () => bench.look(false));
    for (const event of ["pointerdown", "pointerup", "pointermove"]) this.element.addEventListener(event, (one) => one.stopPropagation());
    bench.watch(() => this.draw());
  }

  private draw(): void {
    const { bench } = this;
    const { picture } = bench;
    const n = bench.coordinates.length;
    this.element.hidden = !bench.state.drawing || !picture || bench.inPlace || n < 2;
    if (this.element.hidden || !picture) return;
    const names = picture.loci.coordinates.join(", ");
    this.words.textContent = n === 3 ? `Surfaces over ${names}` : `Loci over ${names}`;
    const [x, y] = picture.loci.box;
    this.layer.resize(size);
    const context = this.layer.begin();
    if (n !== 2 || !x || !y) return;
    const view = fit({ low: [x[0], y[0]], high: [x[1], y[1]] }, { width: size.width, height: size.height - 20 }, false, 8);
    const shown = shownOf(picture, undefined, new Set(bench.state.hidden));
    drawWorkspace(context, view, shown.rings, bench.theme);
    drawBox(context, view, { low: [x[0], y[0]], high: [x[1], y[1]] }, bench.theme);
    drawCurves(context, view, shown, bench.theme, { strength: 1, proven: bench.proven });
    drawPoints(context, view, shown, bench.theme);
  }
}
