// The side of the page: what the curves mean, values to change, modes to choose, what the pose does.
import type { Loci, Sketch, Zone } from "../data/answers";
import { roundText } from "../data/exact";
import { areaWords, lengthWords } from "../data/units";
import type { Adjustable } from "../data/model_text";
import { groupKey, idsOf } from "../draw/loci";
import { boxAround, drawSketch, placesOf } from "../draw/mechanism";
import { fit } from "../draw/view";
import { h, replace, section } from "./dom";
import { legendSample } from "./legend_sample";
import { readingOf } from "./reading";
import type { Stage } from "./stage";
import type { Workbench } from "./workbench";

export interface Panel {
  element: HTMLElement;
  update(news: Set<string>): void;
}

/** What is under the pointer: what vanishes, why, its degree and formula. */
export function readingPanel(bench: Workbench, stage: Stage): Panel {
  const body = h("div", { class: "reading", "aria-live": "polite" });
  const hint = (): string =>
    bench.coordinates.length === 1
      ? "The marks on the strip below are the loci; the legend names the reactions that vanish there. Drag the end effector, or along the strip."
      : !bench.traceable
        ? "No loci are drawn over more than three coordinates. Set the pose and a task by their numbers."
        : `Point at a ${bench.coordinates.length === 3 ? "surface" : "curve"}: this panel shows which reactions vanish there, the condition and the formula. Drag the end effector, the joints on the ground, or the empty plane.`;
  const zoneWords = (zone: Zone): string =>
    `${zone.id}: ${areaWords(zone.area, bench.units)}, largest circle of radius ${lengthWords(zone.inscribed_circle.radius, bench.units)}${zone.certified ? ", proven" : ", not proven"}`;
  const show = (): void => {
    const { hovered } = stage;
    if (hovered?.curve) return replace(body, readingOf(bench.rules, hovered.curve));
    const zone = bench.zones?.zones.find((one) => one.id === hovered?.zone);
    replace(body, h("p", { class: "quiet" }, zone ? `zone ${zoneWords(zone)}` : hint()));
  };
  stage.onHover = show;
  show();
  return { element: section("Under the pointer", true, body), update: (news) => (news.has("loci") || news.has("model")) && show() };
}

/** The legend of the curves, each of which can be switched off. */
export function legendPanel(bench: Workbench): Panel {
  const body = h("div", { class: "legend" });
  const notes = h("div", { class: "quiet" });
  const proof = h("p", { class: "quiet proof", role: "status" });
  const toggle = (key: string, on: boolean): void => {
    const hidden = bench.state.hidden.filter((one) => one !== key);
    bench.change({ hidden: on ? hidden : [...hidden, key] });
  };
  let signature = "";
  const show = (): void => {
    const { picture, theme } = bench;
    proof.textContent = picture ? proofWords(picture.loci, bench.proven) : "";
    if (picture && !bench.proven) return; // the rows are those of the last design until the next is proven
    if (!picture) {
      signature = "";
      replace(body);
      return replace(notes);
    }
    const groups = [...picture.curve_groups, ...picture.point_groups, ...picture.surface_groups];
    const incomplete = picture.loci.complete ? "" : incompleteWords(picture.loci);
    const now = JSON.stringify([groups.map((group) => [group.kind, group.what, groupKey(group), idsOf(group)]), bench.state.hidden, bench.dark, picture.notes, incomplete, bench.zonesFault]);
    if (now === signature) return;
    signature = now;
    const rows = groups.map((group) => {
      const key = groupKey(group);
      const box = h("input", { type: "checkbox", change: () => toggle(key, box.checked) });
      box.checked = !bench.state.hidden.includes(key);
      const why = "why" in group && group.why ? h("span", { class: "quiet" }, ` ${group.why}`) : undefined;
      return h("label", { class: "legend-row" }, box, legendSample(group, theme), h("span", {}, group.what, idsOf(group) && h("span", { class: "quiet" }, ` (${idsOf(group)})`), why));
    });
    replace(body, ...rows, ...picture.remarks.map((remark) => h("p", { class: "quiet" }, remark)));
    replace(
      notes,
      ...notesInShort(picture.notes).map((note) => h("p", {}, note)),
      incomplete ? h("p", { class: "fault" }, incomplete) : undefined,
      bench.zonesFault ? h("p", { class: "fault" }, `zones: ${bench.zonesFault}`) : undefined,
    );
  };
  const element = section("Loci", true, proof, body, notes);
  const title = element.querySelector("summary");
  const name = (): void => {
    element.hidden = !bench.traceable;
    const [only, ...more] = bench.coordinates;
    if (title) title.textContent = only && more.length === 0 ? `Loci: values of ${only.name}` : more.length === 2 ? "Loci: surfaces" : "Loci: curves";
  };
  return { element, update: (news) => (news.has("model") && name(), ["loci", "zones", "state.hidden", "state.file", "theme"].some((one) => news.has(one)) && show()) };
}

/** Which of the two answers is shown. */
export function proofWords(loci: Loci, proven: boolean): string {
  if (!proven) return "Not yet proven: carried over from the last design, in short dashes";
  const all = [...loci.curves, ...(loci.surfaces ?? []), ...loci.isolated_points];
  return loci.complete && all.every((one) => one.certified) ? "Proven" : "";
}

/** Why not all loci are known. */
export function incompleteWords(loci: { open?: readonly unknown[] }): string {
  const places = (loci.open ?? []).length;
  if (places === 0) return "incomplete: stopped at the time limit";
  return `incomplete: ${places} ${places === 1 ? "place" : "places"} at which a locus is not proven`;
}

/** Reactions that no load reaches are told in one note, not in one each. */
export function notesInShort(notes: readonly string[]): string[] {
  const idle = / is zero in every pose under these loads$/;
  const names = notes.filter((note) => idle.test(note)).map((note) => note.replace(idle, ""));
  const others = notes.filter((note) => !idle.test(note));
  return names.length > 1 ? [...others, `${names.join(", ")} are zero in every pose under these loads`] : [...notes];
}

const groups: [Adjustable["group"], string, boolean][] = [
  ["parameters", "Parameters", true],
  ["lengths", "Lengths", false],
  ["loads", "Loads", true],
  ["springs", "Springs", true],
  ["gravity", "Gravity", false],
  ["points", "Points on the ground", false],
  ["clearances", "Clearances", false],
];

/** Sliders with exact values beside them, for everything in the file that is a number of its own. */
export function valuesPanel(bench: Workbench): Panel {
  const body = h("div", {});
  const rows = new Map<string, { text: HTMLInputElement; slider: HTMLInputElement; fault: HTMLElement }>();
  let ids = "";

  const row = (one: Adjustable): HTMLElement => {
    const name = one.id;
    const fault = h("div", { class: "fault", id: `fault-${name}`, role: "alert" });
    const text = h("input", { type: "text", class: "exact", "aria-label": `${one.label}, exact`, "aria-describedby": `fault-${name}`, spellcheck: "false", autocomplete: "off" });
    const slider = h("input", { type: "range", "aria-label": one.label, step: "any", "data-id": name });
    text.addEventListener("change", () => bench.setValue(name, text.value));
    slider.addEventListener("input", () => {
      const step = (Number(slider.max) - Number(slider.min)) / 400;
      bench.setValue(name, roundText(Number(slider.value), step), `slide-${name}`);
    });
    slider.addEventListener("change", () => {
      bench.history.endGesture();
      range(slider, bench.adjustable(name));
    });
    rows.set(name, { text, slider, fault });
    return h("div", { class: "value-row" }, h("label", {}, h("span", { class: "value-name", title: one.label }, one.label), slider), text, h("span", { class: "unit" }, one.unit), fault);
  };

  const build = (list: Adjustable[]): void => {
    rows.clear();
    replace(
      body,
      ...groups.flatMap(([group, title, open]) => {
        const own = list.filter((one) => one.group === group);
        return own.length > 0 ? [section(title, open, ...own.map(row))] : [];
      }),
    );
    for (const one of list) {
      const entry = rows.get(one.id);
      if (entry) range(entry.slider, one);
    }
  };

  const update = (): void => {
    const list = bench.model.adjustables;
    const now = list.map((one) => one.id).join();
    if (now !== ids) {
      ids = now;
      build(list);
    }
    for (const one of list) {
      const entry = rows.get(one.id);
      if (!entry) continue;
      const wrong = bench.fault?.field === one.id;
      if (document.activeElement !== entry.text || !wrong) entry.text.value = one.text;
      entry.slider.disabled = one.value === undefined;
      entry.slider.style.visibility = one.value === undefined ? "hidden" : "visible"; // an expression has no place on it
      if (document.activeElement !== entry.slider && one.value !== undefined && (one.value > Number(entry.slider.max) || one.value < Number(entry.slider.min))) range(entry.slider, one);
      if (one.value !== undefined) entry.slider.value = String(one.value);
      entry.fault.textContent = wrong ? bench.fault?.message ?? "" : "";
      entry.text.setAttribute("aria-invalid", String(wrong));
    }
  };
  return { element: body, update: (news) => (news.has("state") || news.has("fault") || news.has("loci") || news.has("model")) && update() };
}

/** From nothing to the next round number well above the value, or as far to both sides: 0.35 of 0 to 1, -30 of -50 to 50. */
function range(slider: HTMLInputElement, one: Adjustable | undefined): void {
  const value = one?.value;
  if (value === undefined) return;
  const largest = roundAbove(1.4 * (Math.abs(value) || (one?.unit === "N" ? 100 : 1)));
  const free = one?.group === "points" || one?.group === "loads" || one?.group === "gravity" || value < 0;
  slider.min = String(free ? -largest : 0);
  slider.max = String(largest);
  slider.value = String(value);
}

/** The least of 1, 2, 5, 10, ... times a power of ten that is as large. */
export function roundAbove(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const digit = [1, 2, 5, 10].find((one) => one * power >= value * (1 - 1e-12)) ?? 10;
  return Number((digit * power).toPrecision(12));
}

/** Working modes as small pictures. */
export function modesPanel(bench: Workbench): Panel {
  const body = h("div", { class: "modes", role: "radiogroup", "aria-label": "Working mode" });
  const element = section("Working mode", true, body);
  const show = (): void => {
    const { modes, facts, state, theme } = bench;
    element.hidden = (facts?.dyads.length ?? 0) === 0;
    if (!facts) return;
    const own = state.mode ?? facts.dyads.map((dyad) => dyad.side);
    const words = (mode: number[]): string => facts.dyads.map((dyad, k) => `${dyad.point} ${mode[k] === 1 ? dyad.left : dyad.right}`).join(", ");
    if (!modes || modes.modes.length === 0) {
      const sides = facts.dyads.map((dyad, k) => {
        const select = h("select", { "aria-label": dyad.point, change: () => bench.change({ mode: own.map((side, i) => (i === k ? Number(select.value) : side)) }) }, h("option", { value: 1 }, dyad.left), h("option", { value: -1 }, dyad.right));
        select.value = String(own[k]);
        return h("label", {}, dyad.point, " ", select);
      });
      return replace(body, ...sides);
    }
    replace(
      body,
      ...modes.modes.map((one) => {
        const chosen = one.mode.length === own.length && one.mode.every((side, k) => side === own[k]);
        const canvas = thumbnail(one.sketch, theme);
        return h("button", { type: "button", class: "mode", role: "radio", "aria-checked": String(chosen), title: words(one.mode), click: () => bench.change({ mode: one.mode, ...(bench.state.at ? {} : { at: one.sample ?? undefined }) }) }, canvas, h("span", {}, `${words(one.mode)}${one.sample === null ? ": no pose found" : ""}`));
      }),
    );
  };
  return { element, update: (news) => ["modes", "kind", "theme", "state.mode"].some((one) => news.has(one)) && show() };
}

function thumbnail(sketch: Sketch | undefined, theme: Workbench["theme"]): HTMLCanvasElement {
  const ratio = window.devicePixelRatio || 1;
  const size = { width: 84, height: 62 };
  const canvas = h("canvas", { width: size.width * ratio, height: size.height * ratio, "aria-hidden": "true" });
  const context = canvas.getContext("2d");
  const box = sketch && boxAround(placesOf(sketch));
  if (!context || !box) return canvas;
  context.scale(ratio, ratio);
  drawSketch(context, fit(box, size, true, 7), sketch, theme, 4);
  return canvas;
}

/** Which joints and which reactions count. */
export function countingPanel(bench: Workbench): Panel {
  const body = h("div", { class: "counting" });
  const element = section("What counts", false, body);
  const quantities: [string, string][] = [["f", "contact forces"], ["M", "actuators' couples"], ["F", "actuators' forces"], ["N", "normal forces"], ["T", "couples borne"], ["fx", "fx alone"], ["fy", "fy alone"]];
  const show = (): void => {
    const { facts, state } = bench;
    if (!facts) return;
    const any = facts.joints.some((joint) => joint.clearance);
    const usual = facts.joints.filter((joint) => joint.clearance || !any).map((joint) => joint.name);
    const joints = state.joints ?? usual;
    const chosen = state.quantities ?? ["f", "M"];
    const box = (label: string, on: boolean, change: (on: boolean) => void): HTMLElement => {
      const input = h("input", { type: "checkbox", change: () => change(input.checked) });
      input.checked = on;
      return h("label", { class: "tick" }, input, label);
    };
    const next = (list: string[], name: string, on: boolean): string[] => (on ? [...list, name] : list.filter((one) => one !== name));
    replace(
      body,
      h("fieldset", {}, h("legend", {}, "Joints"), ...facts.joints.map((joint) => box(joint.name, joints.includes(joint.name), (on) => {
        const list = facts.joints.map((one) => one.name).filter((name) => next(joints, joint.name, on).includes(name));
        if (list.length > 0) bench.change({ joints: list });
        else show();
      }))),
      h("fieldset", {}, h("legend", {}, "Reactions"), ...quantities.map(([name, words]) => box(`${name}: ${words}`, chosen.includes(name), (on) => {
        const list = next(chosen, name, on);
        if (list.length > 0) bench.change({ quantities: list });
        else show();
      }))),
      h("fieldset", {}, h("legend", {}, "Drawn"),
        box("zones", state.zones, (on) => bench.change({ zones: on })),
        box("reactions as arrows", state.reactions, (on) => bench.change({ reactions: on })),
        box("take-up of clearances", state.takeUp, (on) => bench.change({ takeUp: on }))),
    );
  };
  return { element, update: (news) => ["kind", "state.joints", "state.quantities", "state.zones", "state.reactions", "state.takeUp"].some((one) => news.has(one)) && show() };
}
