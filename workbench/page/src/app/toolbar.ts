// The tools beside the sheet, what may be snapped to, and looking.
import { tools } from "../drawing/tools/list";
import type { DrawingStage } from "./drawing_stage";
import { h } from "./dom";

function icon(path: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  line.setAttribute("d", path);
  svg.append(line);
  return svg;
}

export function toolbar(stage: DrawingStage): HTMLElement {
  const hint = h("div", { class: "tool-hint quiet", role: "status" });
  const buttons = tools.map((tool) => {
    const button = h("button", { type: "button", class: "tool", "data-tool": tool.id, title: `${tool.label} (${tool.key.toUpperCase()}): ${tool.hint}`, click: () => stage.take(tool) }, icon(tool.icon), h("span", {}, tool.label));
    return [tool, button] as const;
  });
  const look = (label: string, title: string, click: () => void): HTMLElement => h("button", { type: "button", class: "tool", title, click }, h("span", {}, label));
  const toggle = (key: "grid" | "lengths", label: string, title: string): HTMLElement => {
    const button = h("button", { type: "button", class: "tool", title, "aria-pressed": String(stage.snapping[key]), click: () => {
      stage.snapping[key] = !stage.snapping[key];
      button.setAttribute("aria-pressed", String(stage.snapping[key]));
    } }, h("span", {}, label));
    return button;
  };
  stage.onTool = () => {
    for (const [tool, button] of buttons) button.setAttribute("aria-pressed", String(tool === stage.tool));
    hint.textContent = `${stage.tool.label}: ${stage.tool.hint}.`;
  };
  stage.onTool();
  return h(
    "div",
    { class: "drawing-tools" },
    h("div", { class: "tools", role: "toolbar", "aria-label": "Tools" },
      ...buttons.map(([, button]) => button),
      toggle("grid", "Grid", "Snap to the grid"),
      toggle("lengths", "Lengths", "Snap to round lengths and to those of other links, and write them as given lengths"),
      look("Fit", "Show all (0)", () => stage.showAll()),
      look("+", "Nearer (+)", () => stage.zoom(1.25)),
      look("−", "Farther (-)", () => stage.zoom(0.8))),
    hint,
  );
}
