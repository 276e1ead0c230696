// What the mechanism does in the pose: where it is, how far off, what each joint bears.
import type { Pose } from "../data/answers";
import { reactionName } from "../data/answers";
import { parseExact, shortNumber, toNumber } from "../data/exact";
import { lengthWords, turnWords, unitOf, type Unit, type Units } from "../data/units";
import { h, replace, section } from "./dom";
import type { Panel } from "./panels";
import { playBar } from "./play";
import type { Stage } from "./stage";
import type { Workbench } from "./workbench";

function errorWords(pose: Pose, units: Units): string {
  const error = pose.pose_error;
  if (!error) return `undefined: ${pose.vanishing.map(reactionName).join(", ")} vanish${pose.vanishing.length === 1 ? "es" : ""}`;
  return Object.entries(error)
    .map(([name, value]) => `${name} ${name.startsWith("dalpha") ? turnWords(value, units) : lengthWords(value, units)}`)
    .join(", ");
}

/** Of the components of a reaction: f, N and F are forces, m, M and T couples. */
function isForce(name: string): boolean {
  return !/^(m|M|T)/.test(name);
}

/** `largest`: of all reactions; what is nothing beside it is rounding. Forces in the file's unit, couples in N m. */
function reactionCells(parts: Record<string, number | null>, largest: number, units: Units): string {
  const rounding = 1e-12 * largest;
  return Object.entries(parts)
    .map(([name, value]) => `${name} ${shortNumber(value === null ? null : (Math.abs(value) < rounding ? 0 : value) / (isForce(name) ? units.force.size : 1))}`)
    .join("  ");
}

export function posePanel(bench: Workbench, stage: Stage): Panel {
  const fields = h("div", { class: "pose-fields" });
  const fault = h("div", { class: "fault", role: "alert" });
  const facts = h("dl", { class: "facts" });
  const table = h("table", { class: "reactions" });
  const inputs: HTMLInputElement[] = [];

  const unit = (k: number): Unit => unitOf(bench.units, bench.coordinates[k]?.angle ?? false);
  let built = "";
  const build = (): void => {
    inputs.length = 0;
    replace(
      fields,
      ...bench.coordinates.map((coordinate, k) => {
        const input = h("input", { type: "text", class: "exact", "aria-label": `${coordinate.name} of the pose`, autocomplete: "off" });
        input.addEventListener("change", () => {
          const exact = parseExact(input.value);
          const at = [...(bench.state.at ?? [])];
          if (!exact) {
            fault.textContent = `'${input.value}' is no number; write one such as 0.25 or 7/20`;
            return;
          }
          at[k] = Number((toNumber(exact) * unit(k).size).toPrecision(15));
          bench.change({ at });
        });
        const slider = h("input", { type: "range", min: coordinate.lower, max: coordinate.upper, step: "any", "aria-label": `${coordinate.name} of the pose`, class: "pose-slider" });
        slider.addEventListener("input", () => {
          const at = [...(bench.state.at ?? [])];
          at[k] = Number(Number(slider.value).toPrecision(6));
          stage.movePose(at, `pose-${k}`);
        });
        slider.addEventListener("change", () => bench.history.endGesture());
        inputs.push(input, slider);
        return h("label", { class: "value-row" }, h("span", { class: "value-name" }, coordinate.name), slider, input, h("span", { class: "unit" }, unit(k).name));
      }),
    );
  };

  const update = (): void => {
    const { pose, state } = bench;
    const signature = JSON.stringify([bench.coordinates, bench.units]);
    if (signature !== built) build();
    built = signature;
    bench.coordinates.forEach((_, k) => {
      const [input, slider] = [inputs[2 * k], inputs[2 * k + 1]];
      const value = state.at?.[k];
      if (value === undefined || !input || !slider) return;
      if (document.activeElement !== input) input.value = String(Number((value / unit(k).size).toPrecision(7)));
      slider.value = String(value);
    });
    fault.textContent = bench.poseFault ?? "";
    if (!pose) {
      replace(facts);
      return replace(table);
    }
    const worst = pose.worst_case["dp"];
    const shown: [string, string][] = [
      ["pose error", errorWords(pose, bench.units)],
      ["at worst, any load", lengthWords(worst, bench.units)],
      ["|A|", `${shortNumber(pose.determinant)}${pose.singular ? ": singular" : ""}`],
      ["condition", shortNumber(pose.condition)],
    ];
    if (!bench.facts?.spatial && state.takeUp && bench.coordinates.length < 3) shown.push(["take-up drawn", `${stage.magnification.toLocaleString("en")} times as large`]);
    replace(facts, ...shown.flatMap(([name, value]) => [h("dt", {}, name), h("dd", { "data-fact": name }, value)]));
    const largest = Math.max(0, ...Object.values(pose.reactions).flatMap((parts) => Object.values(parts).map((value) => Math.abs(value ?? 0))));
    const lost = new Set(pose.vanishing.map((one) => one.joint));
    replace(
      table,
      h("caption", {}, `Reactions, ${bench.units.force.name} and N m`),
      h("tbody", {}, ...Object.entries(pose.reactions).map(([joint, parts]) => h("tr", lost.has(joint) ? { class: "lost" } : {}, h("th", { scope: "row" }, joint), h("td", {}, reactionCells(parts, largest, bench.units), lost.has(joint) ? " — vanishes" : "")))),
    );
  };
  return {
    element: section("Pose", true, fields, playBar(bench, (n) => n > 1), fault, facts, h("div", { class: "scroll" }, table)),
    update: (news) => ["pose", "model", "state", "view"].some((one) => news.has(one)) && update(),
  };
}
