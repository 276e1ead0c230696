// The legend of the viewer: what is drawn, with a switch each.
import { h } from "../app/dom";
import { legendSample } from "../app/legend_sample";
import { groupKey } from "../draw/loci";
import { themeOf, type Settings } from "./view";

export function legend(settings: Settings, refresh: () => void): HTMLElement[] {
  const { data, hidden } = settings;
  return [...data.curve_groups, ...data.point_groups, ...data.surface_groups].map((group) => {
    const key = groupKey(group);
    const box = h("input", { type: "checkbox", change: () => {
      if (box.checked) hidden.delete(key);
      else hidden.add(key);
      refresh();
    } });
    box.checked = !hidden.has(key);
    return h("label", { class: "legend-row" }, box, legendSample(group, themeOf(settings)), h("span", {}, group.what, "why" in group && group.why ? h("span", { class: "quiet" }, ` ${group.why}`) : undefined));
  });
}
