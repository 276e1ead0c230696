// The legend of the viewer: what is drawn, with a switch each.
import { h } from "../app/dom";
import { legendSample } from "../app/legend_sample";
import { groupKey, idsOf } from "../draw/loci";
import { themeOf, type Settings } from "./view";

/** Under which zones are switched off. */
export const zonesKey = "zones";

export function legend(settings: Settings, refresh: () => void): HTMLElement[] {
  const { data, hidden } = settings;
  const rows: HTMLElement[] = [...data.curve_groups, ...data.point_groups, ...data.surface_groups].map((group) => {
    const key = groupKey(group);
    const box = h("input", { type: "checkbox", change: () => {
      if (box.checked) hidden.delete(key);
      else hidden.add(key);
      refresh();
    } });
    box.checked = !hidden.has(key);
    return h("label", { class: "legend-row" }, box, legendSample(group, themeOf(settings)), h("span", {}, group.what, idsOf(group) && h("span", { class: "quiet" }, ` (${idsOf(group)})`), "why" in group && group.why ? h("span", { class: "quiet" }, ` ${group.why}`) : undefined));
  });
  rows.push(...data.remarks.map((remark) => h("p", { class: "quiet" }, remark)));
  if (data.zones.length === 0) return rows;
  const zones = h("input", { type: "checkbox", change: () => {
    if (zones.checked) hidden.delete(zonesKey);
    else hidden.add(zonesKey);
    refresh();
  } });
  zones.checked = !hidden.has(zonesKey);
  const sample = h("span", { class: "zone-sample", "aria-hidden": "true" }, ...themeOf(settings).zones.slice(0, 3).map((colour) => h("span", { style: `background: ${colour}` })));
  return [...rows, h("label", { class: "legend-row" }, zones, sample, h("span", {}, "zones, the largest first"))];
}
