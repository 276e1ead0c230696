import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { parse } from "yaml";
import { appendItem, insertEntry, nodeAt, parseFile, pathAt, removeAt, setValue } from "./file_text";

const examples = new URL("../../../../examples/", import.meta.url);
const files = readdirSync(examples).filter((name) => name.endsWith(".yaml")).map((name) => [name, readFileSync(new URL(name, examples), "utf8")] as const);
const plain = (text: string): unknown => parse(text, { schema: "failsafe" }) as unknown;

describe("an edit of a file", () => {
  const file = "# mine\nformat: 1\nlinks:   # bars\n  AB: {points: [A, B]}   # the crank\n  BC:\n    points: [B, C]\n    mass: 2   # kg\n# loads\nloads:\n  - {link: AB, at: B}   # pull\n";
  it("adds an entry to a block, to braces, to nothing", () => {
    expect(insertEntry(file, ["links"], "CD", "{points: [C, D]}")).toBe(file.replace("kg\n", "kg\n  CD: {points: [C, D]}\n"));
    expect(insertEntry(file, ["links", "AB"], "mass", "3")).toBe(file.replace("[A, B]}", "[A, B], mass: 3}"));
    expect(insertEntry(file, ["links", "BC"], "length", "3")).toBe(file.replace("kg\n", "kg\n    length: 3\n"));
    expect(insertEntry(file, ["links", "AB", "clearance"], "radial", "3")).toBe(file.replace("[A, B]}", "[A, B], clearance: {radial: 3}}"));
    expect(insertEntry("format: 1\nlinks:\nloads: []\n", ["links"], "A", "1")).toBe("format: 1\nlinks:\n  A: 1\nloads: []\n");
    expect(insertEntry("links: {}   # none\n", ["links"], "A", "1")).toBe("links:   # none\n  A: 1\n");
    expect(insertEntry("", ["links"], "A", "1")).toBe("links:\n  A: 1\n");
  });
  it("writes new sections in the order of files", () => {
    expect(insertEntry(file, ["joints"], "A", "1")).toBe(file.replace("# loads\n", "joints:\n  A: 1\n# loads\n"));
    expect(insertEntry(file, [], "gravity", "[0, -9.81]")).toBe(file.replace("format: 1\n", "format: 1\ngravity: [0, -9.81]\n"));
  });
  it("adds an item to a list", () => {
    expect(appendItem(file, ["loads"], "{link: BC}")).toBe(`${file}  - {link: BC}\n`);
    expect(appendItem(file, ["links", "AB", "points"], "D")).toBe(file.replace("[A, B]", "[A, B, D]"));
    expect(appendItem(file, ["springs"], "1")).toBe(file.replace("# loads\n", "springs:\n  - 1\n# loads\n"));
    expect(appendItem("loads: []\n", ["loads"], "1")).toBe("loads:\n  - 1\n");
  });
  it("removes an entry with its line, and what it leaves empty", () => {
    expect(removeAt(file, ["links", "AB"])).toBe(file.replace("  AB: {points: [A, B]}   # the crank\n", ""));
    expect(removeAt(file, ["links", "BC"])).toBe(file.replace("  BC:\n    points: [B, C]\n    mass: 2   # kg\n", ""));
    expect(removeAt(file, ["links", "AB", "points", 0])).toBe(file.replace("[A, B]}", "[B]}"));
    expect(removeAt(file, ["links", "AB", "points", 1])).toBe(file.replace("[A, B]}", "[A]}"));
    expect(removeAt(file, ["loads", 0])).toBe(file.slice(0, file.indexOf("loads:")));
    expect(removeAt(file, ["loads", 7])).toBe(file);
  });
  it("puts a value in the place of another, of whatever form", () => {
    expect(setValue(file, ["links", "BC", "mass"], "7/2")).toBe(file.replace("mass: 2 ", "mass: 7/2 "));
    expect(setValue(file, ["links", "BC"], "{points: [B]}")).toBe(file.replace("  BC:\n    points: [B, C]\n    mass: 2 ", "  BC: {points: [B]} "));
    expect(setValue("a:\nb: 1\n", ["a"], "2")).toBe("a: 2\nb: 1\n");
  });
  it("finds what stands at a place of the text", () => {
    expect(pathAt(file, 4, 3)).toEqual(["links", "AB"]);
    expect(pathAt(file, 4, 18)).toEqual(["links", "AB", "points", 0]);
    expect(pathAt(file, 10, 6)).toEqual(["loads", 0, "link"]);
    expect(pathAt(file, 1, 1)).toEqual([]);
  });
  it.each(files)("and back leaves %s as it was", (_, text) => {
    for (const section of ["links", "joints", "points", "workspace", "made"]) {
      const added = insertEntry(text, [section], "zz", "{a: [1, 2]}");
      expect(nodeAt(parseFile(added), [section, "zz", "a", 1])?.toString()).toBe("2");
      expect(removeAt(added, [section, "zz"])).toBe(text);
    }
    const more = appendItem(text, ["loads"], "{link: zz}");
    const list = (plain(more) as { loads: unknown[] }).loads;
    expect(list.at(-1)).toEqual({ link: "zz" });
    expect(removeAt(more, ["loads", list.length - 1])).toBe(text);
  });
});
