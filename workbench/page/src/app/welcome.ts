// What a first visitor needs to know.
import { h } from "./dom";
import type { Workbench } from "./workbench";

const seen = "clearloci-welcomed";
let dialog: HTMLDialogElement | undefined;

export function welcome(bench: Workbench): HTMLElement {
  const kinds = bench.rules.kinds.filter((one) => ["contact-loss", "backlash", "direct-singularity", "workspace-boundary"].includes(one.kind));
  const close = h("button", { type: "button", class: "primary", click: () => dialog?.close() }, "Start designing");
  dialog = h(
    "dialog",
    { class: "welcome", "aria-label": "What this shows" },
    h("h2", {}, "Where does this mechanism lose contact?"),
    h("p", {}, "Every real joint has clearance. Where the reaction in a joint vanishes, its parts lose contact and cross the clearance, and the end effector jumps. The coloured curves are all poses at which that happens; the coloured areas between them are zones without such poses."),
    h("dl", {}, ...kinds.flatMap((one) => [h("dt", {}, one.words), h("dd", {}, one.happens)])),
    h("ul", {},
      h("li", {}, h("strong", {}, "Drag the end effector"), " — at the load arrow: posture, reactions and error are updated; a curve that you cross flashes, and a message names the reactions that vanish."),
      h("li", {}, h("strong", {}, "Drag a joint on the ground, or move a slider"), ": the curves follow. Type exact values such as 7/20."),
      h("li", {}, h("strong", {}, "Draw"), " changes the mechanism itself: links, pins, motors, forces; New begins with an empty sheet."),
      h("li", {}, h("strong", {}, "Draw a task"), ": it is proven free of loci while you move it, or refuted with a witness."),
      h("li", {}, "With the keyboard: Tab to the picture, arrow keys move the end effector (Shift: small steps), + − 0 zoom, Ctrl+Z undoes.")),
    close,
  );
  dialog.addEventListener("close", () => localStorage.setItem(seen, "1"));
  if (!localStorage.getItem(seen) && !bench.nothing) queueMicrotask(() => dialog?.showModal());
  return dialog;
}

export function openWelcome(): void {
  dialog?.showModal();
}
