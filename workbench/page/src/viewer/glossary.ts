// The words of the page, for readers who have no documentation at hand.
import { h } from "../app/dom";

const words: [string, string][] = [
  ["|A|", "determinant of the equations of force balance; where it is zero the mechanism is singular"],
  ["backlash", "the play of an actuator; the actuator crosses it where its couple or force changes its sign"],
  ["contact loss", "the force in a joint is zero: the pin crosses its clearance from one side to another"],
  ["direct singularity", "a pose in which |A| = 0: the actuators cannot hold the end effector"],
  ["dyad", "two links that place a point at given distances from two others; it closes to the left or to the right"],
  ["excited", "said of a direct singularity at which some reaction grows without bound under this load"],
  ["margin locus", "the poses at which a reaction has the least size that is allowed"],
  ["take-up", "how far the parts of a joint are displaced by its clearance, in the direction of its force"],
  ["working mode", "the list of sides to which the dyads are assembled"],
  ["workspace", "the poses that the end effector can reach in this working mode"],
  ["zone", "a part of the workspace without loci: inside it no joint crosses its clearance"],
];

export function glossary(): HTMLElement {
  return h("details", { class: "glossary" }, h("summary", {}, "Glossary"), h("dl", {}, ...words.flatMap(([word, meaning]) => [h("dt", {}, word), h("dd", {}, meaning)])));
}
