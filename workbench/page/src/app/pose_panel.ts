// What the mechanism does in the pose: where it is, how far off, what each joint bears.
import type { Pose } from "../data/answers";
import { reactionName } from "../data/answers";
import { lengthWords, parseExact, shortNumber, toNumber } from "../data/exact";
import { h, replace, section } from "./dom";
import type { Panel } from "./panels";
import type { Stage } from "./stage";
import type { Workbench } from "./workbench";

function errorWords(pose: Pose): string {
  const error = pose.pose_error;
  if (!error) return `undefined: ${pose.vanishing.map(reactionName).join(", ")} vanish${pose.vanishing.length === 1 ? "es" : ""}`;
  return Object.entries(error)
    .map(([name, value]) => `${name} ${name.startsWith("dalpha") ? `${shortNumber((value ?? NaN) * 1e3, 3)} mrad` : lengthWords(value)}`)
    .join(", ");
}

/** `largest`: of all reactions; what is nothing beside it is rounding. */
function reactionCells(parts: Record<string, number | null>, largest: number): string {
  const rounding = 1e-12 * largest;
  return Object.entries(parts)
    .map(([name, value]) => `${name} ${shortNumber(value !== null && Math.abs(value) < rounding ? 0 : value)}`)
    .join("  ");
}

export function posePanel(bench: Workbench, stage: Stage): Panel {
  const fields = h("div", { class: "pose-fields" });
  const fault = h("div", { class: "fault", role: "alert" });
  const facts = h("dl", { class: "facts" });
  const table = h("table", { class: "reactions" });
  const inputs: HTMLInputElement[] = [];

  const degrees = (k: number): number => (bench.coordinates[k]?.angle ? 180 / Math.PI : 1);
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
          at[k] = toNumber(exact) / degrees(k);
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
        return h("label", { class: "value-row" }, h("span", { class: "value-name" }, coordinate.name), slider, input, h("span", { class: "unit" }, coordinate.angle ? "deg" : "m"));
      }),
    );
  };

  const update = (): void => {
    const { pose, state } = bench;
    if (inputs.length !== 2 * bench.coordinates.length) build();
    bench.coordinates.forEach((_, k) => {
      const [input, slider] = [inputs[2 * k], inputs[2 * k + 1]];
      const value = state.at?.[k];
      if (value === undefined || !input || !slider) return;
      if (document.activeElement !== input) input.value = String(Number((value * degrees(k)).toPrecision(7)));
      slider.value = String(value);
    });
    fault.textContent = bench.poseFault ?? "";
    if (!pose) return;
    const worst = pose.worst_case["dp"];
    const shown: [string, string][] = [
      ["pose error", errorWords(pose)],
      ["at worst, any load", lengthWords(worst)],
      ["|A|", `${shortNumber(pose.determinant)}${pose.singular ? ": singular" : ""}`],
      ["condition", shortNumber(pose.condition)],
    ];
    if (!bench.facts?.spatial && state.takeUp && bench.coordinates.length < 3) shown.push(["take-up drawn", `${stage.magnification.toLocaleString("en")} times as large`]);
    replace(facts, ...shown.flatMap(([name, value]) => [h("dt", {}, name), h("dd", { "data-fact": name }, value)]));
    const largest = Math.max(0, ...Object.values(pose.reactions).flatMap((parts) => Object.values(parts).map((value) => Math.abs(value ?? 0))));
    const lost = new Set(pose.vanishing.map((one) => one.joint));
    replace(
      table,
      h("tbody", {}, ...Object.entries(pose.reactions).map(([joint, parts]) => h("tr", lost.has(joint) ? { class: "lost" } : {}, h("th", { scope: "row" }, joint), h("td", {}, reactionCells(parts, largest), lost.has(joint) ? " — lets go" : "")))),
    );
  };
  return {
    element: section("Pose", true, fields, fault, facts, h("div", { class: "scroll" }, table)),
    update: (news) => (news.has("pose") || news.has("model") || news.has("state")) && update(),
  };
}
