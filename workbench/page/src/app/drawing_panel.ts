// What belongs to the whole drawing: its name, its units, its parameters.
import { insertEntry, removeAt, setValue, typed, wordAt, type ValuePath } from "../data/file_text";
import { jointFields } from "../drawing/fields";
import { firstFree } from "../drawing/names";
import { rename, renameFault } from "../drawing/rename";
import { h, replace, section } from "./dom";
import type { Panel } from "./panels";
import type { Workbench } from "./workbench";

const units: [key: string, label: string, usual: string, names: string[]][] = [
  ["length", "lengths", "m", ["m", "cm", "mm", "in"]],
  ["angle", "angles", "rad", ["rad", "deg"]],
  ["force", "forces", "N", ["N", "kN"]],
];

export function drawingPanel(bench: Workbench): Panel {
  const name = h("input", { type: "text", class: "wide", "aria-label": "Name of the mechanism", autocomplete: "off" });
  const body = h("div", {});
  const parameters = h("div", { class: "parameters" });
  const clearances = h("div", {});
  const fault = h("div", { class: "fault", role: "alert" });
  const write = (path: ValuePath, value: string): void => bench.edit(setValue(bench.state.text, path, typed(value)));
  name.addEventListener("change", () => name.value.trim() !== "" && write(["name"], name.value.trim()));
  const selects = units.map(([key, label, usual, names]) => {
    const select = h("select", { "aria-label": `unit of ${label}`, change: () => write(["units", key], select.value) }, ...names.map((one) => h("option", { value: one }, one)));
    return { key, usual, select, row: h("label", { class: "tick" }, label, " ", select) };
  });
  const cell = (label: string, value: string, change: (value: string) => void): HTMLInputElement => {
    const input = h("input", { type: "text", class: "exact", "aria-label": label, value, spellcheck: "false", autocomplete: "off" });
    input.addEventListener("change", () => input.value.trim() !== "" && change(input.value.trim()));
    return input;
  };
  const add = h("button", { type: "button", click: () => {
    const taken = [...bench.drawing.parameters, ...bench.drawing.points, ...bench.drawing.coordinates].map((one) => one.name);
    bench.edit(insertEntry(bench.state.text, ["parameters"], firstFree(taken, (k) => `a${k + 1}`), "100"));
  } }, "Add a parameter");
  replace(
    body,
    h("label", { class: "on-field" }, h("span", {}, "name"), name),
    h("div", {}, ...selects.map((one) => one.row), h("p", { class: "quiet" }, "If you choose another unit, the numbers do not change.")),
    parameters,
    fault,
    add,
    section("Clearances and fits", false, h("p", { class: "quiet" }, "A number, or a fit of ISO 286 with its diameter: H7/g6 12."), clearances),
  );
  /** What cannot be done leaves what is written. */
  const change = (text: string | undefined): void => {
    if (text !== undefined) return bench.edit(text);
    shown = "";
    update();
  };
  let shown = "";
  const update = (): void => {
    const { text } = bench.state;
    if (document.activeElement !== name) name.value = wordAt(text, ["name"]) ?? "";
    for (const { key, usual, select } of selects) select.value = wordAt(text, ["units", key]) ?? usual;
    const { parameters: list, joints: pins } = bench.drawing;
    const fits = pins.flatMap((joint) => jointFields(bench.drawing, joint, bench.units.length.name));
    const now = JSON.stringify([list, fits]);
    if (now === shown) return;
    shown = now;
    replace(
      parameters,
      ...list.map((one) =>
        h("div", { class: "parameter-row" },
          cell(`name of parameter ${one.name}`, one.name, (value) => {
            change(rename(bench.drawing, "parameter", one.name, value));
            fault.textContent = renameFault(bench.drawing, "parameter", one.name, value) ?? "";
          }),
          cell(`value of parameter ${one.name}`, one.text, (value) => write(["parameters", one.name], value)),
          h("button", { type: "button", "aria-label": `Delete parameter ${one.name}`, click: () => bench.edit(removeAt(bench.state.text, ["parameters", one.name])) }, "×"))),
    );
    replace(
      clearances,
      ...fits.map((one, k) => {
        const input = cell(`${one.label} in the table`, one.text, () => undefined);
        input.placeholder = one.hint;
        input.addEventListener("change", () => {
          const joint = bench.drawing.joints.flatMap((own) => jointFields(bench.drawing, own, bench.units.length.name))[k];
          change(joint?.write(input.value));
        });
        return h("label", { class: "on-field" }, h("span", {}, one.label), input, h("span", { class: "unit" }, one.unit));
      }),
    );
  };
  return { element: section("Drawing", true, body), update: (news) => (news.has("state") || news.has("model")) && update() };
}
