// Beside the thing that is selected: its numbers to type, what it is or is not, and a way to take it away.
import { fieldsOf, nameField, switchesOf, titleOf } from "../drawing/fields";
import { placeOfElement, type Element } from "../drawing/element";
import { boxAround } from "../draw/mechanism";
import { page } from "../draw/view";
import { extentOf } from "../drawing/picture";
import type { DrawingStage } from "./drawing_stage";
import { h, replace } from "./dom";
import type { Workbench } from "./workbench";

export class OnElement {
  readonly element = h("form", { class: "on-element", hidden: true, "aria-label": "What is selected" });
  private built = "";

  constructor(private readonly bench: Workbench, private readonly stage: DrawingStage) {
    stage.followers.push(() => this.show());
    this.element.addEventListener("submit", (event) => event.preventDefault());
  }

  private show(): void {
    const { selected, canvas } = this.stage;
    const held = canvas.dataset["grip"] !== undefined && canvas.dataset["grip"] !== "view";
    this.element.hidden = selected === undefined || held;
    if (!selected || held) {
      if (!selected) this.built = "";
      return;
    }
    this.put(selected);
    const { drawing } = this.bench;
    const name = nameField(drawing, selected);
    const fields = [...(name ? [name] : []), ...fieldsOf(drawing, selected)];
    const switches = switchesOf(drawing, selected);
    const now = JSON.stringify([selected, fields, switches, titleOf(drawing, selected)]);
    if (now === this.built) return;
    const typing = document.activeElement instanceof HTMLInputElement && this.element.contains(document.activeElement) ? document.activeElement.name : undefined;
    this.built = now;
    const fault = h("div", { class: "fault", role: "alert" });
    replace(
      this.element,
      h("strong", {}, titleOf(drawing, selected)),
      ...fields.map((field, k) => {
        const input = h("input", { type: "text", class: "exact", name: field.label, value: field.text, placeholder: field.hint, "aria-label": field.label, spellcheck: "false", autocomplete: "off" });
        input.addEventListener("change", () => {
          const now = nameField(this.bench.drawing, selected);
          const written = [...(now ? [now] : []), ...fieldsOf(this.bench.drawing, selected)][k];
          const text = written?.write(input.value);
          fault.textContent = written?.fault?.(input.value) ?? "";
          if (text === undefined) return void (input.value = field.text);
          if (field.label === "name" && "name" in selected) this.stage.selected = { ...selected, name: input.value.trim() };
          this.bench.edit(text);
        });
        return h("label", { class: "on-field" }, h("span", {}, field.label), input, h("span", { class: "unit" }, field.unit));
      }),
      ...switches.map((one, k) => {
        const box = h("input", { type: "checkbox" });
        box.checked = one.on;
        box.addEventListener("change", () => {
          const text = switchesOf(this.bench.drawing, selected)[k]?.flip();
          if (text !== undefined) this.bench.edit(text);
        });
        return h("label", { class: "tick" }, box, one.label);
      }),
      fault,
      h("button", { type: "button", click: () => this.stage.removeSelected() }, "Delete"),
    );
    if (typing !== undefined) this.element.querySelector<HTMLInputElement>(`[name="${CSS.escape(typing)}"]`)?.focus();
  }

  /** Beside the thing, away from the middle of what is drawn, within the sheet. */
  private put(selected: Element): void {
    const place = placeOfElement(this.bench.drawing, selected);
    const { clientWidth: width, clientHeight: height } = this.stage.canvas;
    const [x, y] = place ? page(this.stage.view, place) : [20, 20];
    const own = { width: this.element.offsetWidth || 220, height: this.element.offsetHeight || 110 };
    const box = boxAround(extentOf(this.bench.drawing));
    const middle = box ? page(this.stage.view, [(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2]) : [x, y];
    const left = x < (middle[0] ?? x) - 1 ? x - 26 - own.width : x + 26;
    const top = y < (middle[1] ?? y) - 1 ? y - 22 - own.height : y + 22;
    this.element.style.left = `${Math.max(6, Math.min(left, width - own.width - 6))}px`;
    this.element.style.top = `${Math.max(6, Math.min(top, height - own.height - 6))}px`;
  }
}
