import { describe, expect, it } from "vitest";
import type { Picture } from "../data/answers";
import { fromHash, toHash } from "./address";
import { alongPlay, passed } from "./play";
import { stepTowards } from "./pull";
import { freshState, History, noDemands, type TaskState } from "./state";
import { handles, movedShape, outline, taskText, withHandle } from "./task_text";
import { alongPath, signChanges } from "./way";

describe("undo", () => {
  it("takes a gesture for one step", () => {
    const history = new History(freshState("a", "0"));
    for (const text of ["1", "2", "3"]) history.set({ ...history.present, text }, "slide");
    history.endGesture();
    history.set({ ...history.present, text: "4" }, "slide");
    expect(history.present.text).toBe("4");
    history.undo();
    expect(history.present.text).toBe("3");
    history.undo();
    expect(history.present.text).toBe("0");
    history.undo();
    expect(history.present.text).toBe("0");
    history.redo();
    history.redo();
    expect(history.present.text).toBe("4");
    expect(history.canRedo).toBe(false);
  });
  it("takes back a gesture that is cancelled, and nothing before it", () => {
    const history = new History(freshState("a", "0"));
    history.set({ ...history.present, text: "1" });
    history.endGesture();
    history.cancelGesture();
    expect(history.present.text).toBe("1");
    for (const text of ["2", "3"]) history.set({ ...history.present, text }, "drag");
    history.cancelGesture();
    expect(history.present.text).toBe("1");
    expect(history.canRedo).toBe(false);
  });
  it("forgets what was undone once something else is done", () => {
    const history = new History(freshState("a", "0"));
    history.set({ ...history.present, text: "1" });
    history.undo();
    history.set({ ...history.present, text: "2" });
    expect(history.canRedo).toBe(false);
  });
});

describe("the address", () => {
  it("holds the whole state", async () => {
    const state = { ...freshState("five.yaml", "name: Ü # comment\n".repeat(50)), at: [0.25, -0.7], mode: [1, -1], zones: false, hidden: ["a|b|c"] };
    const hash = await toHash(state);
    expect(hash.length).toBeLessThan(600);
    expect(hash).toMatch(/^#[\w-]+$/);
    expect(await fromHash(hash)).toEqual(state);
  });
  it.each(["", "#", "#nonsense", "#AAAA", "#%%%"])("gives nothing for %s", async (hash) => {
    expect(await fromHash(hash)).toBeUndefined();
  });
});

describe("tasks", () => {
  const box = { kind: "box", low: [0, 0], high: [2, 1] } as const;
  it("are written as their files are", () => {
    const text = taskText({ ...noDemands, shape: { ...box, low: [0, 0], high: [2, 1] }, margin: "1/100", minForce: "5" }, { names: ["x", "y"] });
    expect(text).toBe("format: 1\nbox: {x: [0, 2], y: [0, 1]}\nmargin: 1/100\nmin_force: 5\n");
    expect(taskText({ ...noDemands, shape: { kind: "path", points: [[0, 0.1], [1, 1]] }, loads: "[[1, 2], [3, 4]]" }, { names: ["x", "y"] })).toBe("format: 1\npath: [[0, 0.1], [1, 1]]\nloads_from: [[1, 2], [3, 4]]\n");
  });
  it("ask for tolerances and for loads that are off, in brackets or without", () => {
    const shape = { ...box, low: [0, 0] as [number, number], high: [2, 1] as [number, number] };
    const lines = "tolerances: {L: 0.1e-3}\nloads_within: [{load: 1, radius: 20}]\n";
    expect(taskText({ ...noDemands, shape, tolerances: "L: 0.1e-3", loadsWithin: "{load: 1, radius: 20}" }, { names: ["x", "y"] })).toContain(lines);
    expect(taskText({ ...noDemands, shape, tolerances: "{L: 0.1e-3}", loadsWithin: "[{load: 1, radius: 20}]" }, { names: ["x", "y"] })).toContain(lines);
  });
  it("over other coordinates are boxes, angles in degrees, lengths in the unit given", () => {
    const text = taskText({ ...noDemands, shape: { kind: "ranges", low: [0, 0.5, Math.PI / 6], high: [0.1, 0.5, Math.PI / 4] } }, { names: ["x", "z", "phi"], angles: [false, false, true], unit: "m" });
    expect(text).toBe("format: 1\nbox: {x: [0 m, 0.1 m], z: 0.5 m, phi: [30 deg, 45 deg]}\n");
  });
  it("of links of earlier versions demand nothing new", async () => {
    const task = { shape: { kind: "circle", centre: [0, 0], radius: 1 }, margin: "1", minForce: "", minCouple: "", loads: "" };
    const hash = await toHash({ ...freshState("five.yaml", "name: x"), task: task as unknown as TaskState });
    expect((await fromHash(hash))?.task).toEqual({ ...noDemands, ...task });
  });
  it("move, and change by their handles", () => {
    expect(movedShape({ kind: "circle", centre: [1, 1], radius: 2 }, [1, -1])).toEqual({ kind: "circle", centre: [2, 0], radius: 2 });
    const shape = { kind: "box" as const, low: [0, 0] as [number, number], high: [2, 1] as [number, number] };
    expect(withHandle(shape, 2, [3, 4])).toEqual({ kind: "box", low: [0, 0], high: [3, 4] });
    expect(withHandle(shape, 0, [5, 5])).toEqual({ kind: "box", low: [2, 1], high: [5, 5] }); // past the opposite corner
    expect(handles(shape)).toHaveLength(4);
    expect(outline(shape)).toHaveLength(5);
  });
});

describe("a pull", () => {
  it("brings the point there where two coordinates move it, and nearest where one does", () => {
    const step = stepTowards([0, 0], [3, 4], [[2, 0], [0, 4]]);
    expect(step[0]).toBeCloseTo(1.5, 2);
    expect(step[1]).toBeCloseTo(1, 2);
    expect(stepTowards([0, 0], [3, 4], [[1, 0]])[0]).toBeCloseTo(3, 2);
    expect(stepTowards([0, 0], [3, 4], [[0, 0]])).toEqual([0]);
    // Of many coordinates those move that do most.
    expect(stepTowards([0, 0], [1, 0], [[1, 0], [1e-6, 0], [0, 1]]).map((one) => Math.round(one * 100) / 100)).toEqual([1, 0, 0]);
  });
});

describe("a cycle that plays", () => {
  const picture = { point_groups: [{ points: [0, 1] }], loci: { isolated_points: [{ at: [1], kind: "contact-loss", vanishing: [{ joint: "A", quantity: "f" }] }, { at: [2], kind: "workspace-boundary", vanishing: [] }] } } as unknown as Picture;
  it("goes round a full turn, and else there and back", () => {
    expect([0, 0.25, 1.25].map((part) => alongPlay(0, 4, true, part))).toEqual([0, 1, 1]);
    expect([0, 0.25, 0.5, 0.75, 1].map((part) => alongPlay(1, 3, false, part))).toEqual([1, 2, 3, 2, 1]);
  });
  it("says what it passes, either way, and once", () => {
    expect(passed(picture, [0.5], [1])).toEqual(["f_A"]);
    expect(passed(picture, [1], [1.5])).toEqual([]);
    expect(passed(picture, [3], [0])).toEqual(["f_A"]);
    expect(passed(picture, [1.5], [3])).toEqual([]);
  });
});

describe("ways", () => {
  it("go along a path in even steps", () => {
    const way = alongPath([[0, 0], [1, 0], [1, 1]], 4);
    expect(way.x).toEqual([0, 0.5, 1, 1.5, 2]);
    expect(way.poses).toEqual([0, 0, 0.5, 0, 1, 0, 1, 0.5, 1, 1]);
  });
  it("know where values change their sign", () => {
    expect(signChanges([0, 1, 2, 3], [1, -1, null, 2])).toEqual([0.5]);
    expect(signChanges([0, 1, 2], [1, 0, -1])).toEqual([1]);
  });
});
