// What belongs to the whole drawing: its name, its units, its parameters.
import { insertEntry, removeAt, setValue, typed, wordAt, type ValuePath } from "../data/file_text";
import { firstFree } from "../drawing/names";
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
    h("div", {}, ...selects.map((one) => one.row), h("p", { class: "quiet" }, "Numbers stay as they are written: another unit makes another size.")),
    parameters,
    add,
  );
  let shown = "";
  const update = (): void => {
    const { text } = bench.state;
    if (document.activeElement !== name) name.value = wordAt(text, ["name"]) ?? "";
    for (const { key, usual, select } of selects) select.value = wordAt(text, ["units", key]) ?? usual;
    const list = bench.drawing.parameters;
    const now = JSON.stringify(list);
    if (now === shown) return;
    shown = now;
    replace(
      parameters,
      ...list.map((one) =>
        h("div", { class: "parameter-row" },
          cell(`name of parameter ${one.name}`, one.name, (value) => /^[A-Za-z]\w*$/.test(value) && bench.edit(renamed(bench.state.text, one.name, value))),
          cell(`value of parameter ${one.name}`, one.text, (value) => write(["parameters", one.name], value)),
          h("button", { type: "button", "aria-label": `Delete parameter ${one.name}`, click: () => bench.edit(removeAt(bench.state.text, ["parameters", one.name])) }, "×"))),
    );
  };
  return { element: section("Drawing", true, body), update: (news) => (news.has("state") || news.has("model")) && update() };
}

/** Another name in the place of the first one, of a parameter that stands nowhere else; where it is used the program says so. */
function renamed(text: string, from: string, to: string): string {
  const value = wordAt(text, ["parameters", from]);
  return value === undefined ? text : insertEntry(removeAt(text, ["parameters", from]), ["parameters"], to, typed(value));
}
