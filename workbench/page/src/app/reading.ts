// What is said of a curve, a surface or a point under the pointer.
import type { Curve, Rules } from "../data/answers";
import { reactionName } from "../data/answers";
import { toLatex } from "../data/exact";
import { h } from "./dom";

export type Readable = Pick<Curve, "kind" | "vanishing"> & Partial<Pick<Curve, "id" | "cause" | "factor" | "implicit" | "certified">>;

export function readingOf(rules: Rules, one: Readable): HTMLElement {
  const kind = rules.kinds.find((own) => own.kind === one.kind);
  const names = one.vanishing.map(reactionName).join(", ");
  const formula = one.implicit?.polynomial;
  const longest = 240;
  return h(
    "div",
    { class: "curve-reading" },
    h("p", {}, one.id ? `${one.id}: ` : "", h("strong", {}, names ? `${names} = 0` : kind?.words ?? one.kind), names ? ` — ${kind?.words ?? one.kind}` : ""),
    one.cause ? h("p", {}, one.cause) : undefined,
    h("p", { class: "quiet" }, kind?.happens ?? ""),
    formula ? h("p", {}, `degree ${one.implicit?.degree}${one.certified ? ", proven" : ", not proven"}`) : undefined,
    formula ? h("code", { class: "formula" }, formula.length > longest ? `${formula.slice(0, longest)} …` : `${formula} = 0`) : undefined,
    formula ? h("button", { type: "button", class: "copy", click: () => void navigator.clipboard.writeText(`${toLatex(formula)} = 0`) }, "Copy as LaTeX") : undefined,
  );
}
