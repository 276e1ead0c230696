import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { ModelText } from "./model_text";

const examples = new URL("../../../../examples/", import.meta.url);
const read = (name: string): string => readFileSync(new URL(name, examples), "utf8");
const fiveBar = read("five_bar.yaml");

describe("a mechanism file", () => {
  it("changes one value and keeps everything else, comments too", () => {
    const changed = new ModelText(fiveBar).write(["parameters", "L"], "7/20").text;
    expect(changed).toBe(fiveBar.replace("L: 0.5 ", "L: 7/20 "));
    const before = fiveBar.split("\n");
    expect(changed.split("\n").filter((line, k) => line !== before[k])).toHaveLength(1);
  });
  it("changes values inside lists and mappings on one line", () => {
    const model = new ModelText(fiveBar);
    expect(model.write(["loads", 0, "force", 1], "-50").read(["loads", 0, "force", 1])).toBe("-50");
    expect(model.write(["joints", "A1", "clearance", "radial"], "20e-6").text).toContain("clearance: {radial: 20e-6, angular: 0.5e-3}}");
    expect(model.write(["points", "A1", 0], "0.1").text).toContain("A1: [0.1, 0]");
  });
  it("keeps the unit in which a value is written", () => {
    const model = new ModelText("units: {length: mm}\nparameters:\n  k: 2 N/mm\n  turn: 30 deg\n  L: 200\n");
    const row = (id: string): unknown => model.adjustables.find((one) => one.id === `parameters/${id}`);
    expect(row("k")).toMatchObject({ text: "2", unit: "N/mm", value: 2 });
    expect(row("L")).toMatchObject({ text: "200", unit: "", value: 200 });
    expect(model.writeNumber(["parameters", "k"], "3").read(["parameters", "k"])).toBe("3 N/mm");
    expect(model.writeNumber(["parameters", "turn"], "0.5 rad").read(["parameters", "turn"])).toBe("0.5 rad");
    expect(model.writeNumber(["parameters", "L"], "7/20").read(["parameters", "L"])).toBe("7/20");
    const refused = model.write(["parameters", "k"], "2 mm");
    expect(refused.writeNumber(["parameters", "k"], "3", model).read(["parameters", "k"])).toBe("3 N/mm");
    expect(model.units).toMatchObject({ declared: true, length: { name: "mm", size: 1e-3 }, angle: { name: "deg" } });
  });
  it("keeps a wrong value one value", () => {
    const wrong = new ModelText(fiveBar).write(["loads", 0, "force", 0], "1, 2], x: [");
    expect(wrong.read(["loads", 0, "force", 0])).toBe("1, 2], x: [");
    expect(wrong.read(["loads", 0, "force", 1])).toBe("-100");
  });
  it("reads y as a name and not as a truth value", () => {
    expect(new ModelText(fiveBar).coordinateNames).toEqual(["x", "y"]);
  });
  it("knows what can be changed", () => {
    const ids = new ModelText(fiveBar).adjustables.map((one) => one.id);
    expect(ids).toEqual(expect.arrayContaining(["parameters/L", "parameters/d", "loads/0/force/1", "points/A2/0", "joints/P/clearance/radial"]));
    expect(ids).not.toContain("points/P/0"); // the end effector is no joint on the ground
    expect(new ModelText(fiveBar).adjustables.find((one) => one.id === "parameters/d")?.value).toBeUndefined();
  });
  it("knows what a block of copies writes out, and changes it there", () => {
    const hexapod = read("hexapod.yaml");
    const model = new ModelText(hexapod);
    const own = model.adjustables.find((one) => one.id === "repeat/table/a/1");
    expect(own).toMatchObject({ label: "a, i = 2", text: "108", value: 108 });
    expect(model.adjustables.map((one) => one.id)).toContain("repeat/joints/S{i}/clearance/axial");
    const changed = model.write(own?.path ?? [], "110").text;
    expect(changed).toBe(hexapod.replace("a: [12, 108,", "a: [12, 110,"));
    expect(model.write(["repeat", "points", "A{i}", 0], "top*cos(a{i})").text).toContain("A{i}: ['top*cos(a{i})',");
  });
  it("knows lengths that are numbers of their own", () => {
    const lengths = new ModelText(read("jansen_leg.yaml")).adjustables.filter((one) => one.group === "lengths");
    expect(lengths[0]).toMatchObject({ id: "points/T/lengths/0", label: "M–T", text: "0.05", unit: "m" });
    expect(new ModelText(fiveBar).adjustables.filter((one) => one.group === "lengths")).toEqual([]);
  });
  it("finds the value at a place of the file", () => {
    const model = new ModelText(fiveBar);
    const line = fiveBar.split("\n").findIndex((one) => one.startsWith("  L: ")) + 1;
    expect(model.at(line, 6, model.adjustables)?.id).toBe("parameters/L");
    expect(model.at(1, 1, model.adjustables)).toBeUndefined();
  });
  it("stays as it is where the path leads nowhere", () => {
    expect(new ModelText(fiveBar).write(["parameters", "nothing"], "1").text).toBe(fiveBar);
    expect(new ModelText(": : [").write(["a"], "1").text).toBe(": : [");
  });
  it.each(readdirSync(examples).filter((name) => name.endsWith(".yaml")))("%s: writing every value as it is changes nothing", (name) => {
    const text = read(name);
    const model = new ModelText(text);
    expect(model.wrong).toBe(false);
    for (const one of model.adjustables) expect(model.writeNumber(one.path, one.text).text).toBe(text);
  });
});
