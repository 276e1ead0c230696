// The words of the page, for readers who have no documentation at hand.
import { h } from "../app/dom";

const words: [string, string][] = [
  ["|A|", "determinant of the equations of force balance; where it is zero the mechanism is singular"],
  ["backlash", "the play of an actuator, which is crossed where its couple or force changes its sign"],
  ["contact loss", "the force in a joint is zero: the pin leaves one side of its clearance and crosses to another"],
  ["direct singularity", "a pose in which |A| = 0: the actuators cannot hold the end effector"],
  ["dyad", "two links that place a point at given distances from two others; it closes to the left or to the right"],
  ["excited", "of a direct singularity: some reaction grows without bound there under this load"],
  ["margin locus", "where a reaction is as small as it is allowed to be"],
  ["take-up", "how far the parts of a joint are displaced by its clearance, in the direction of its force"],
  ["working mode", "to which side each dyad is assembled"],
  ["workspace", "the poses that the end effector can reach in this working mode"],
  ["zone", "a part of the workspace that no locus passes: inside it no clearance changes its side"],
];

export function glossary(): HTMLElement {
  return h("details", { class: "glossary" }, h("summary", {}, "Words"), h("dl", {}, ...words.flatMap(([word, meaning]) => [h("dt", {}, word), h("dd", {}, meaning)])));
}
