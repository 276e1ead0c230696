// What a visitor begins with: twelve mechanisms to look at, an empty sheet, a file of one's own.
import type { ModelFacts, Pose, Theme } from "../data/answers";
import { boxAround, drawSketch, placesOf, projected } from "../draw/mechanism";
import { fit } from "../draw/view";
import { ask, AskingError } from "./asking";
import { newFile } from "../drawing/edit";
import { h } from "./dom";
import type { Workbench } from "./workbench";

const shown: [file: string, title: string, words: string][] = [
  ["five_bar.yaml", "Five-bar", "Two motors place a point in the plane. On the curves a pin loses contact with its hole."],
  ["slider_crank.yaml", "Slider-crank", "A piston and its crank: clearance in the pins and in the guide."],
  ["geared_five_bar.yaml", "Geared five-bar", "One motor, two wheels: where the force between the teeth vanishes, they change flanks."],
  ["scara_belt.yaml", "Arm with a belt", "Both motors on the ground: where the belt carries nothing, its backlash is crossed."],
  ["scissor_lift.yaml", "Scissor lift", "Pins in slots change sides as the load moves across the table."],
  ["cables/hanging.yaml", "Camera on two cables", "Cables only pull: the zone in which both bear as much as they may."],
  ["five_bar_antagonistic.yaml", "Preloaded five-bar", "A third motor presses leg against leg, so that the joints stay loaded."],
  ["klann_leg.yaml", "Klann leg", "A walking leg: where in its step each pin loses contact."],
  ["toggle_press.yaml", "Toggle press", "A small force at the crank causes a large one at the ram."],
  ["three_rrr.yaml", "3-RRR platform", "Three cranks carry a platform that keeps its orientation."],
  ["gough_stewart.yaml", "Gough–Stewart platform", "Six struts in space: surfaces on which the force in a strut vanishes."],
  ["delta.yaml", "Delta robot", "Three arms in space, for picking: its loci are surfaces."],
];

const picture = { width: 200, height: 130 };

export class Gallery {
  readonly element = h("section", { class: "gallery", "aria-label": "Gallery", hidden: true });
  private readonly canvases = new Map<string, HTMLCanvasElement>();
  private readonly poses = new Map<string, { pose: Pose; facts: ModelFacts }>();
  private asked = false;

  constructor(private readonly bench: Workbench) {
    const cards = shown.flatMap(([file, title, words]) => {
      const example = bench.start.examples.find((one) => one.name === file);
      if (!example) return [];
      const canvas = h("canvas", { "aria-hidden": "true" });
      this.canvases.set(file, canvas);
      return [h("button", { type: "button", class: "card", "data-example": file, click: () => bench.open(file, example.text) }, canvas, h("strong", {}, title), h("span", { class: "quiet" }, words))];
    });
    const unit = h("select", { "aria-label": "unit of lengths of the new sheet" }, ...["mm", "cm", "m", "in"].map((one) => h("option", { value: one }, one)));
    this.element.append(
      h("h2", {}, "Where does a mechanism lose contact? Draw one, open a file, or choose one of these"),
      h("div", { class: "buttons" },
        h("button", { type: "button", class: "primary", id: "new-sheet", click: () => bench.open("mechanism.yaml", newFile(unit.value), true) }, "New: an empty sheet"),
        unit,
        h("button", { type: "button", class: "primary", click: () => document.getElementById("open-file")?.click() }, "Open a file"),
        h("span", { class: "quiet" }, "or drop one here")),
      h("div", { class: "cards" }, ...cards),
    );
    bench.watch((news) => {
      this.element.hidden = !bench.nothing;
      if (!bench.nothing) return;
      if (news.has("theme")) this.paint();
      if (!this.asked) void this.ask();
    });
  }

  /** One after the other: a mechanism in a pose of its workspace is a question of some milliseconds. */
  private async ask(): Promise<void> {
    this.asked = true;
    for (const file of this.canvases.keys()) {
      const text = this.bench.start.examples.find((one) => one.name === file)?.text;
      try {
        const facts = await ask<ModelFacts>("model", { text, file, lane: "gallery" });
        if (facts.sample) this.poses.set(file, { facts, pose: await ask<Pose>("pose", { text, file, at: facts.sample, lane: "gallery" }) });
      } catch (error) {
        if (!(error instanceof AskingError)) throw error;
      }
      this.paint();
    }
    this.element.dataset["painted"] = String(this.poses.size);
  }

  private paint(): void {
    for (const [file, { pose, facts }] of this.poses) {
      const canvas = this.canvases.get(file);
      if (canvas) paintCard(canvas, pose, facts, this.bench.theme);
    }
  }
}

function paintCard(canvas: HTMLCanvasElement, pose: Pose, facts: ModelFacts, theme: Theme): void {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = picture.width * ratio;
  canvas.height = picture.height * ratio;
  const context = canvas.getContext("2d");
  const sketch = pose.sketch ?? projected(pose, facts);
  const box = boxAround(placesOf(sketch));
  if (!context || !box) return;
  context.scale(ratio, ratio);
  drawSketch(context, fit(box, picture, true, 22), sketch, theme, facts.spatial ? 5 : 9);
}
