// The head of the page: which mechanism, undo and redo, comparing, the link, light and dark.
import { h, replace } from "./dom";
import { openButton, save } from "./files";
import { newFile } from "../drawing/edit";
import { openWelcome } from "./welcome";
import type { Workbench } from "./workbench";

export function buildHead(bench: Workbench): HTMLElement {
  const title = h("h1", {}, "clearloci");
  const picker = h("select", { id: "examples", "aria-label": "Open an example" });
  picker.append(h("option", { value: "" }, "Examples …"), h("option", { value: "gallery" }, "Gallery"));
  if (bench.start.text !== "") picker.append(h("option", { value: "*" }, `${bench.start.file.split("/").pop()} (as it was opened)`));
  for (const example of bench.start.examples) picker.append(h("option", { value: example.name }, nameOf(example.text, example.name)));
  picker.addEventListener("change", () => {
    const chosen = picker.value === "*" ? { name: bench.start.file, text: bench.start.text } : bench.start.examples.find((one) => one.name === picker.value);
    if (picker.value === "gallery") bench.open("", "");
    picker.value = "";
    if (chosen) bench.open(chosen.name.split("/").pop() ?? "model.yaml", chosen.text);
  });
  const said = h("div", { class: "said", role: "status" });
  const say = (words: string[]): void => {
    replace(said, ...words.map((one) => h("div", {}, one)), ...(words.length > 0 ? [h("button", { type: "button", click: () => replace(said) }, "Close")] : []));
  };
  const fresh = h("button", { type: "button", title: "An empty sheet", click: () => bench.open("mechanism.yaml", newFile(bench.nothing ? "mm" : bench.units.length.name), true) }, "New");
  const store = h("button", { type: "button", id: "save", title: "Download the mechanism file (Ctrl+S)", click: () => save(bench) }, "Save");
  const draw = h("button", { type: "button", id: "draw", title: "Change the mechanism itself, with tools", click: () => bench.look(!bench.state.drawing) }, "Draw");
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.shiftKey) return;
    const key = event.key.toLowerCase();
    if (key !== "s" && key !== "o") return;
    event.preventDefault();
    if (key === "s") save(bench);
    else document.getElementById("open-file")?.click();
  });
  const undo = h("button", { type: "button", title: "Undo (Ctrl+Z)", click: () => bench.undo() }, "Undo");
  const redo = h("button", { type: "button", title: "Redo (Ctrl+Shift+Z)", click: () => bench.redo() }, "Redo");
  const keep = h("button", { type: "button", title: "Keep the loci of this design visible, in faint colours, while you change it", click: () => bench.change({ kept: bench.state.kept ? undefined : { text: bench.state.text, mode: bench.state.mode, preload: bench.state.preload } }) });
  const link = h("button", { type: "button", title: "Copy the address, which contains the mechanism and the view", click: () => void copyLink(link) }, "Copy link");
  const theme = h("button", { type: "button", title: "Light or dark", click: () => {
    localStorage.setItem("clearloci-theme", bench.dark ? "light" : "dark");
    window.dispatchEvent(new Event("clearloci-theme"));
  } });
  const help = h("button", { type: "button", click: () => openWelcome() }, "What is this?");
  bench.watch(() => {
    replace(title, bench.facts?.name ?? (bench.drawing.name || "clearloci"));
    const planar = bench.facts?.spatial !== true;
    draw.disabled = bench.nothing || !planar;
    draw.title = planar ? "Change the mechanism itself, with tools" : "Mechanisms in space cannot be drawn: edit their file";
    draw.setAttribute("aria-pressed", String(bench.state.drawing));
    store.disabled = keep.disabled = link.disabled = bench.nothing;
    undo.disabled = !bench.history.canUndo;
    redo.disabled = !bench.history.canRedo;
    keep.textContent = bench.state.kept ? "Drop the kept design" : "Keep to compare";
    keep.setAttribute("aria-pressed", String(bench.state.kept !== undefined));
    theme.textContent = bench.dark ? "Light" : "Dark";
  });
  return h("header", { class: "head" }, title, h("nav", { "aria-label": "Workbench" }, fresh, openButton(bench, say), store, picker, draw, undo, redo, keep, link, theme, help), said);
}

async function copyLink(button: HTMLButtonElement): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve, 300)); // the address follows the hand a little later
  await navigator.clipboard.writeText(location.href);
  button.textContent = "Copied";
  setTimeout(() => (button.textContent = "Copy link"), 1500);
}

function nameOf(text: string, file: string): string {
  return `${/^name: *(.+)$/m.exec(text)?.[1]?.replace(/\s*#.*/, "") ?? file} — ${file}`;
}
