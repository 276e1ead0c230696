// The mechanism file beside the drawing: what is drawn stands there, what is typed there is drawn.
import { h, section } from "./dom";
import type { Panel } from "./panels";
import type { Workbench } from "./workbench";

export function textPanel(bench: Workbench): Panel {
  const text = h("textarea", { id: "file-text", class: "file-text", spellcheck: "false", autocomplete: "off", "aria-label": "The mechanism file", "aria-describedby": "file-fault" });
  const fault = h("div", { class: "fault", id: "file-fault", role: "alert" });
  text.addEventListener("input", () => bench.edit(text.value, "text"));
  text.addEventListener("change", () => bench.history.endGesture());
  const element = section("File", false, h("p", { class: "quiet" }, "Both ways: what you draw stands here, what you type here is drawn."), text, fault);
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
