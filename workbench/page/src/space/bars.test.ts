import { describe, expect, it } from "vitest";
import type { ModelFacts, Pose } from "../data/answers";
import { barsOf } from "./bars";

const facts = { spatial: true, end_effector: { link: "plate", at: "P" }, links: [{ name: "rod", points: ["A", "P"] }], joints: [] } as unknown as ModelFacts;
const posture = { A: [1, 0, 0], P: [0.1, 0.2, 0.3] };

describe("bars among surfaces", () => {
  it("are those of links where the axes are x, y and z of the end effector", () => {
    expect(barsOf(facts, { at: [0.1, 0.2, 0.3], posture } as unknown as Pose)).toEqual([[[1, 0, 0], [0.1, 0.2, 0.3]]]);
  });
  it("are none over other coordinates, or over the same in another order", () => {
    expect(barsOf(facts, { at: [0.3, 0.1, 0.2], posture } as unknown as Pose)).toEqual([]);
    expect(barsOf(facts, { at: [0.1, 0.2, 0.28], posture } as unknown as Pose)).toEqual([]);
  });
});
