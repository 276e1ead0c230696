// The mechanism file beside the drawing: what is drawn stands there, what is typed there is drawn.
import { pathAtOffset, rangeAt } from "../data/file_text";
import { elementOf, isThere, pathOf } from "../drawing/element";
import type { DrawingStage } from "./drawing_stage";
import { h, section } from "./dom";
import type { Panel } from "./panels";
import type { Workbench } from "./workbench";

export function textPanel(bench: Workbench, sheet: DrawingStage): Panel {
  const text = h("textarea", { id: "file-text", class: "file-text", spellcheck: "false", autocomplete: "off", "aria-label": "The mechanism file", "aria-describedby": "file-fault" });
  const fault = h("div", { class: "fault", id: "file-fault", role: "alert" });
  text.addEventListener("input", () => bench.edit(text.value, "text"));
  text.addEventListener("change", () => bench.history.endGesture());
  // What is selected on the sheet is marked in the file, and the other way round.
  const point = (): void => {
    if (!bench.state.drawing) return;
    const path = pathAtOffset(text.value, text.selectionStart);
    const own = elementOf(path);
    if (own && isThere(bench.drawing, own)) sheet.select(own);
  };
  for (const event of ["click", "keyup"]) text.addEventListener(event, point);
  let marked = "";
  sheet.followers.push(() => {
    const now = JSON.stringify(sheet.selected);
    if (now === marked || !element.open || document.activeElement === text) return;
    marked = now;
    const range = sheet.selected && rangeAt(bench.state.text, pathOf(bench.drawing, sheet.selected));
    if (!range) return;
    text.setSelectionRange(...range);
    text.scrollTop = (text.scrollHeight * bench.state.text.slice(0, range[0]).split("\n").length) / bench.state.text.split("\n").length - text.clientHeight / 2;
  });
  const element = section("File", false, h("p", { class: "quiet" }, "The file of the drawing: a change of the text changes the drawing."), text, fault);
  element.addEventListener("toggle", () => update());
  const update = (): void => {
    if (!element.open) return;
    if (text.value !== bench.state.text) {
      const { selectionStart, selectionEnd, scrollTop } = text;
      text.value = bench.state.text;
      if (document.activeElement === text) text.setSelectionRange(selectionStart, selectionEnd);
      text.scrollTop = scrollTop;
    }
    fault.textContent = bench.missing?.words ?? bench.fault?.message ?? "";
  };
  return { element, update: (news) => ["state", "fault", "loci", "model"].some((one) => news.has(one)) && update() };
}
