// The mechanism in its pose where the plane of the loci is not its own: a small picture in a corner.
import { boxAround, drawSketch, placesOf, projected } from "../draw/mechanism";
import { Layer } from "../draw/surface";
import { fit } from "../draw/view";
import { h } from "./dom";
import type { Workbench } from "./workbench";

const small = { width: 190, height: 150 };

export class Inset {
  readonly element = h("div", { class: "inset", "aria-hidden": "true" });
  private readonly layer: Layer;

  constructor(private readonly bench: Workbench) {
    this.layer = new Layer(this.element, "inset");
    bench.watch((news) => (news.has("pose") || news.has("theme") || news.has("model")) && this.draw());
  }

  private draw(): void {
    const { bench } = this;
    const wanted = bench.coordinates.length > 1 && !bench.inPlace && bench.pose !== undefined && !(bench.coordinates.length === 3 && bench.facts?.spatial);
    this.element.hidden = !wanted;
    if (!wanted || !bench.pose) return;
    // Where there are no loci beside, it has the stage to itself.
    const stage = this.element.parentElement?.getBoundingClientRect();
    const size = bench.traceable || !stage ? small : { width: stage.width - 20, height: stage.height - 60 };
    this.element.style.top = bench.traceable ? "" : "50px";
    this.element.style.width = `${size.width}px`;
    this.element.style.height = `${size.height}px`;
    this.layer.resize(size);
    const context = this.layer.begin();
    const sketch = bench.pose.sketch ?? projected(bench.pose, bench.facts);
    const box = boxAround(placesOf(sketch));
    if (box) drawSketch(context, fit(box, size, true, 14), sketch, bench.theme, 5);
  }
}
