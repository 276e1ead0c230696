// The mechanism file as text whose values change in place: comments, order and spelling of all else stay as they are.
import { isMap, isScalar, isSeq, type Document, type Node } from "yaml";
import { parseExact, toNumber } from "./exact";
import { isPlain, parseFile, type ValuePath } from "./file_text";
import { unitsOf, type Units } from "./units";

export type { ValuePath } from "./file_text";

export interface Adjustable {
  /** "parameters/L", "points/A1/0": the path as a name. */
  id: string;
  path: ValuePath;
  label: string;
  unit: string;
  group: "parameters" | "lengths" | "loads" | "springs" | "gravity" | "points" | "clearances";
  /** As written, without the unit. */
  text: string;
  /** Of a plain number; an expression is typed, not slid. */
  value: number | undefined;
}

export interface FreeEffort {
  joint: string;
  /** "N m", or "N" of a motor that slides; with the file's unit of force. */
  unit: string;
  within: readonly [number, number] | undefined;
}

/** Where nothing else is said: no effort, or that next to none. */
export function usualEffort({ within }: FreeEffort): string {
  return String(within ? Math.min(Math.max(0, within[0]), within[1]) : 0);
}

export class ModelText {
  private readonly document: Document.Parsed;

  constructor(readonly text: string) {
    this.document = parseFile(text);
  }

  private node(path: ValuePath): Node | undefined {
    const found: unknown = this.document.getIn(path, true);
    return found instanceof Object ? (found as Node) : undefined;
  }

  /** The keys of the mapping at this place; none where there is none. */
  private names(path: ValuePath): string[] {
    const map = path.length === 0 ? this.document.contents : this.node(path);
    return isMap(map) ? map.items.flatMap((pair) => (isScalar(pair.key) ? [String(pair.key.value)] : [])) : [];
  }

  read(path: ValuePath): string | undefined {
    const node = this.node(path);
    return isScalar(node) ? String(node.value) : undefined;
  }

  /** The file with this value in the place of the old one. */
  write(path: ValuePath, value: string): ModelText {
    const node = this.node(path);
    if (!isScalar(node) || !node.range || node.value === value) return this;
    const [from, to] = node.range;
    // What is no expression is quoted, so that it stays one value: the program then says what is wrong with it.
    const written = isPlain(value) && node.type !== "QUOTE_SINGLE" ? value : node.type === "QUOTE_SINGLE" ? `'${value.replace(/'/g, "''")}'` : JSON.stringify(value);
    return new ModelText(this.text.slice(0, from) + written + this.text.slice(to));
  }

  /** The same with a plain number in the unit in which the old value is written, or that of `accepted`: 3 in the place of `2 N/mm` is `3 N/mm`. */
  writeNumber(path: ValuePath, value: string, accepted: ModelText = this): ModelText {
    const unit = /^\s*[-+0-9.eE/]+\s+([A-Za-z][\w^*/ ]*?)\s*$/.exec(accepted.read(path) ?? "")?.[1];
    return this.write(path, unit && parseExact(value) ? `${value} ${unit}` : value);
  }

  /** The path of the value at a place of the file (from 1 on), if one of these stands there. */
  at(line: number, column: number, adjustables: Adjustable[]): Adjustable | undefined {
    const lines = this.text.split("\n");
    const place = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0) + column - 1;
    let best: Adjustable | undefined;
    let distance = 0;
    for (const one of adjustables) {
      const range = this.node(one.path)?.range;
      if (!range || lineOf(this.text, range[0]) !== line) continue;
      const away = place < range[0] ? range[0] - place : Math.max(0, place - range[1]);
      if (!best || away < distance) [best, distance] = [one, away];
    }
    return best;
  }

  /** Points with coordinates that are numbers or parameters alone, by whose place the mechanism stands on the ground. */
  get basePoints(): { name: string; path: ValuePath }[] {
    return this.basePointsOf([]);
  }

  /** Of a drawing: what is pinned to the ground, or of no link. */
  private drawnOnGround(root: ValuePath): { name: string; path: ValuePath }[] {
    const scalars = (path: ValuePath): string[] => {
      const node = this.node(path);
      return isSeq(node) ? node.items.map((item) => (isScalar(item) ? String(item.value) : "")) : [];
    };
    const carried = new Set(this.names([...root, "links"]).flatMap((name) => scalars([...root, "links", name, "points"])));
    const pinned = new Set(this.names([...root, "joints"]).flatMap((name) => (scalars([...root, "joints", name, "revolute"]).includes("ground") ? [this.read([...root, "joints", name, "at"]) ?? ""] : [])));
    return this.names([...root, "drawn"]).flatMap((name) => (!carried.has(name) || pinned.has(name) ? [{ name, path: [...root, "drawn", name] }] : []));
  }

  private basePointsOf(root: ValuePath): { name: string; path: ValuePath }[] {
    const free = new Set(this.coordinateNames);
    return [...this.drawnOnGround(root), ...this.builtOnGround(root, free)];
  }

  private builtOnGround(root: ValuePath, free: Set<string>): { name: string; path: ValuePath }[] {
    return this.names([...root, "points"]).flatMap((name) => {
      const path = [...root, "points", name];
      const node = this.node(path);
      if (!isSeq(node) || node.items.length < 2) return [];
      const words = node.items.map((one) => (isScalar(one) ? String(one.value) : "?"));
      const fixed = words.every((word) => !(word.match(/[A-Za-z_]\w*/g) ?? []).some((symbol) => free.has(symbol)));
      return fixed && !words.includes("?") ? [{ name, path }] : [];
    });
  }

  /** The file's own unit of this measure; without any, SI. */
  unit(measure: "length" | "angle" | "force"): string {
    return this.read(["units", measure]) ?? { length: "m", angle: "rad", force: "N" }[measure];
  }

  /** What answers are shown in. */
  get units(): Units {
    const said = (key: string): string | undefined => this.read(["units", key]);
    return unitsOf(this.node(["units"]) ? { length: said("length"), angle: said("angle"), force: said("force") } : undefined);
  }

  /** How many m the file's unit of length is. */
  get metres(): number {
    return this.units.length.size;
  }

  /** How tasks write their lengths, which are m on the page. */
  get taskUnit(): string {
    return this.read(["units", "length"]) === undefined ? "" : "m";
  }

  /** Of a drawing without any the motors', which turn. */
  get coordinateNames(): string[] {
    const names = this.names(["workspace"]);
    if (names.length > 0 || this.names(["drawn"]).length === 0) return names;
    return this.names(["joints"]).filter((name) => this.read(["joints", name, "actuated"]) === "true" && this.node(["joints", name, "revolute"]) !== undefined);
  }

  /** Motors whose effort is chosen, with what they can exert where it is written in plain numbers. */
  get freeEfforts(): FreeEffort[] {
    return this.sections.flatMap((root) =>
      this.names([...root, "joints"]).flatMap((joint) => {
        const path = [...root, "joints", joint];
        if (this.read([...path, "actuated", "effort"]) !== "free") return [];
        const [least, most] = [0, 1].map((end) => parseExact(this.read([...path, "actuated", "within", end]) ?? ""));
        const unit = this.node([...path, "prismatic"]) ? this.unit("force") : `${this.unit("force")} m`;
        return [{ joint, unit, within: least && most ? ([toNumber(least), toNumber(most)] as const) : undefined }];
      }),
    );
  }

  get adjustables(): Adjustable[] {
    return this.sections.flatMap((root) => this.adjustablesOf(root));
  }

  /** The file itself, and every block of `repeat`, whose sections are read like its own. */
  private get sections(): ValuePath[] {
    const repeat = this.node(["repeat"]);
    if (isSeq(repeat)) return [[], ...repeat.items.map((_, k): ValuePath => ["repeat", k])];
    return isMap(repeat) ? [[], ["repeat"]] : [[]];
  }

  private adjustablesOf(root: ValuePath): Adjustable[] {
    const list: Adjustable[] = [];
    const add = (path: ValuePath, label: string, unit: string, group: Adjustable["group"]): void => {
      const text = this.read(path);
      if (text === undefined) return;
      const [, number = text, own = ""] = /^\s*([-+0-9.eE/]+)\s+([A-Za-z][\w^*/ ]*?)\s*$/.exec(text) ?? [];
      const exact = parseExact(number);
      const shown = { m: this.unit("length"), rad: this.unit("angle"), N: this.unit("force"), "N m": `${this.unit("force")} m` }[unit] ?? unit;
      list.push({ id: path.join("/"), path, label, unit: exact && own ? own : shown, group, text: exact && own ? number : text, value: exact && toNumber(exact) });
    };
    const addVector = (path: ValuePath, label: string, unit: string, group: Adjustable["group"]): void => {
      const node = this.node(path);
      if (!isSeq(node)) return;
      node.items.forEach((_, axis) => add([...path, axis], `${label} ${"xyz"[axis] ?? axis}`, unit, group));
    };
    for (const name of this.names([...root, "parameters"])) add([...root, "parameters", name], name, "", "parameters");
    for (const name of root.length > 0 ? this.names([...root, "table"]) : []) {
      const row = this.node([...root, "table", name]);
      if (isSeq(row)) row.items.forEach((_, k) => add([...root, "table", name, k], `${name}, ${this.copyWords(root, k)}`, "", "parameters"));
    }
    this.addLengths(root, add);
    this.addLoads(root, add, addVector);
    addVector([...root, "gravity"], "gravity", "m/s²", "gravity");
    for (const point of this.basePointsOf(root)) addVector(point.path, point.name, "m", "points");
    for (const name of this.names([...root, "joints"])) {
      for (const [key, unit] of [["radial", "m"], ["angular", "rad"], ["gap", "m"], ["half_length", "m"], ["axial", "m"]])
        add([...root, "joints", name, "clearance", key ?? ""], `${name} ${(key ?? "").replace("_", " ")}`, unit ?? "", "clearances");
    }
    return list;
  }

  /** "i = 2" of the second value of a row of a table. */
  private copyWords(root: ValuePath, k: number): string {
    const counter = this.names(root).find((name) => isSeq(this.node([...root, name])));
    return counter === undefined ? String(k + 1) : `${counter} = ${this.read([...root, counter, k]) ?? k + 1}`;
  }

  /** Lengths of links that are numbers of their own; of those that are formulas the parameters are moved. */
  private addLengths(root: ValuePath, add: (path: ValuePath, label: string, unit: string, group: Adjustable["group"]) => void): void {
    const addNumber = (path: ValuePath, label: string): void => {
      if (parseExact(this.read(path) ?? "")) add(path, label, "m", "lengths");
    };
    for (const name of this.names([...root, "links"])) addNumber([...root, "links", name, "length"], name);
    for (const name of this.names([...root, "points"])) {
      const path = [...root, "points", name];
      for (const end of [0, 1]) addNumber([...path, "lengths", end], `${this.read([...path, "dyad", end]) ?? ""}–${name}`);
      addNumber([...path, "length"], `${this.read([...path, "from"]) ?? ""}–${name}`);
    }
  }

  private addLoads(
    root: ValuePath,
    add: (path: ValuePath, label: string, unit: string, group: Adjustable["group"]) => void,
    addVector: (path: ValuePath, label: string, unit: string, group: Adjustable["group"]) => void,
  ): void {
    const loads = this.node([...root, "loads"]);
    if (isSeq(loads)) {
      loads.items.forEach((_, index) => {
        const path = [...root, "loads", index];
        const where = this.read([...path, "at"]) ?? this.read([...path, "link"]) ?? "";
        addVector([...path, "force"], `force at ${where},`, "N", "loads");
        add([...path, "couple"], `couple on ${this.read([...path, "link"]) ?? ""}`, "N m", "loads");
        addVector([...path, "couple"], `couple at ${where},`, "N m", "loads");
      });
    }
    const springs = this.node([...root, "springs"]);
    if (isSeq(springs)) {
      const units = { stiffness: "", free_length: "m", force: "N", rest: "rad" };
      springs.items.forEach((_, index) => {
        const path = [...root, "springs", index];
        const name = this.read([...path, "name"]) ?? `S${index + 1}`;
        for (const [key, unit] of Object.entries(units)) add([...path, key], `${name} ${key.replace("_", " ")}`, unit, "springs");
      });
    }
  }

  get wrong(): boolean {
    return this.document.errors.length > 0;
  }
}

function lineOf(text: string, place: number): number {
  let line = 1;
  for (let i = 0; i < place; ++i) if (text[i] === "\n") ++line;
  return line;
}
