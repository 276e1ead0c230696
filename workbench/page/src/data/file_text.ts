// Edits of a YAML text that leave every other byte where it is: comments, order and spelling stay. Each takes the text and
// gives the changed one; values are handed over as they are to be written.
import { isMap, isPair, isScalar, isSeq, parseDocument, type Document, type Node, type Pair, type YAMLMap, type YAMLSeq } from "yaml";
import { parseExact } from "./exact";

/** Where a value stands in a file. */
export type ValuePath = (string | number)[];

/** The order in which sections are written where they are new. */
const sectionOrder = ["format", "name", "space", "units", "gravity", "parameters", "workspace", "frames", "drawn", "points", "links", "joints", "springs", "limits", "repeat", "end_effector", "loads"];

/** The last texts that were read: one hand asks the same one many times. */
const parsed = new Map<string, Document.Parsed>();
const kept = 8;

/** Not to be changed: the next who asks gets the same. */
export function parseFile(text: string): Document.Parsed {
  const known = parsed.get(text);
  if (known) return known;
  // "failsafe": every scalar is a text, as the program reads it; `y` is no truth value.
  const document = parseDocument(text, { schema: "failsafe", keepSourceTokens: false });
  if (parsed.size >= kept) parsed.delete(parsed.keys().next().value ?? "");
  parsed.set(text, document);
  return document;
}

export function nodeAt(document: Document.Parsed, path: ValuePath): Node | undefined {
  const found: unknown = path.length === 0 ? document.contents : document.getIn(path, true);
  return found instanceof Object ? (found as Node) : undefined;
}

/** Whether a value is one without quotes, wherever it stands. */
export function isPlain(value: string): boolean {
  return /^[\w.+\-*/^() ]+$/.test(value);
}

/** A value as it is typed, in quotes where it would be more than one. */
export function typed(value: string): string {
  return isPlain(value) ? value : JSON.stringify(value);
}

/** The scalar at this place, as text. */
export function wordAt(text: string, path: ValuePath): string | undefined {
  const node = nodeAt(parseFile(text), path);
  return isScalar(node) ? String(node.value) : undefined;
}

/** Where a coordinate can be written by the hand: a number of its own, or a parameter that stands there alone. */
export function slotOf(text: string, path: ValuePath): ValuePath | undefined {
  const word = wordAt(text, path)?.trim();
  if (word === undefined) return undefined;
  if (parseExact(word)) return path;
  return wordAt(text, ["parameters", word]) === undefined ? undefined : ["parameters", word];
}

const isEmpty = (node: Node | undefined): boolean => !node || (isScalar(node) && (node.value === null || node.value === ""));

function pairOf(map: YAMLMap, key: string): Pair | undefined {
  return map.items.find((pair) => isScalar(pair.key) && String(pair.key.value) === key);
}

/** Where a node's own text ends, before comments and the end of its line. */
function endOf(node: unknown): number {
  if (isPair(node)) return node.value ? endOf(node.value) : ((node.key as Node).range?.[1] ?? 0) + 1;
  if ((isMap(node) || isSeq(node)) && !node.flow && node.items.length > 0) return endOf(node.items.at(-1));
  return (node as Node).range?.[1] ?? 0;
}

/** An empty value, as of `links:`, has its place behind the colon. */
function startOf(node: unknown): number {
  const first: unknown = isPair(node) ? node.key : node;
  return (first as Node).range?.[0] ?? 0;
}

function lineStart(text: string, place: number): number {
  return text.lastIndexOf("\n", place - 1) + 1;
}

function afterLine(text: string, place: number): number {
  if (place > 0 && text[place - 1] === "\n") return place;
  const end = text.indexOf("\n", place);
  return end < 0 ? text.length : end + 1;
}

function splice(text: string, from: number, to: number, put: string): string {
  return text.slice(0, from) + put + text.slice(to);
}

/** A line of its own behind what ends at this place. */
function insertLine(text: string, end: number, line: string): string {
  const at = afterLine(text, end);
  return splice(text, at, at, `${at > 0 && text[at - 1] !== "\n" ? "\n" : ""}${line}\n`);
}

function insertSection(text: string, name: string, lines: string): string {
  const { contents } = parseFile(text);
  if (!isMap(contents)) return `${text}${text === "" || text.endsWith("\n") ? "" : "\n"}${name}:${lines}\n`;
  const rank = sectionOrder.indexOf(name);
  const before = contents.items.filter((pair) => isScalar(pair.key) && sectionOrder.indexOf(String(pair.key.value)) < rank).at(-1);
  return before ? insertLine(text, endOf(before), `${name}:${lines}`) : `${name}:${lines}\n${text}`;
}

/** The mapping at `path` with one more entry; it is made where there is none. */
export function insertEntry(text: string, path: ValuePath, key: string, value: string): string {
  const document = parseFile(text);
  const node = nodeAt(document, path);
  const name = path.at(-1);
  if (path.length === 0) return insertSection(text, key, ` ${value}`);
  if (isMap(node) && node.items.length > 0) {
    const last = node.items.at(-1);
    if (node.flow) return splice(text, endOf(last), endOf(last), `, ${key}: ${value}`);
    const first = startOf(node.items[0]);
    return insertLine(text, endOf(last), `${" ".repeat(first - lineStart(text, first))}${key}: ${value}`);
  }
  if (path.length === 1) return openSection(text, String(name), `${key}: ${value}`);
  return setValue(text, path, `{${key}: ${value}}`);
}

/** A section that is absent or empty, with its first line. */
function openSection(text: string, name: string, line: string): string {
  const { contents } = parseFile(text);
  const pair = isMap(contents) ? pairOf(contents, name) : undefined;
  if (!pair) return insertSection(text, name, `\n  ${line}`);
  const value = pair.value as Node | null;
  const colon = ((pair.key as Node).range?.[1] ?? 0) + 1;
  const written = isEmpty(value ?? undefined) ? text : splice(text, colon, endOf(value), "");
  return insertLine(written, colon, `  ${line}`);
}

/** The value at this place, in the place of the one before or as a new entry. */
export function setValue(text: string, path: ValuePath, value: string): string {
  const document = parseFile(text);
  const node = nodeAt(document, path);
  const parent = path.slice(0, -1);
  const key = path.at(-1);
  if (isEmpty(node) || !node?.range) {
    const map = nodeAt(document, parent);
    const pair = isMap(map) && typeof key === "string" ? pairOf(map, key) : undefined;
    if (!pair) return insertEntry(text, parent, String(key), value);
    const colon = ((pair.key as Node).range?.[1] ?? 0) + 1;
    return splice(text, colon, colon, ` ${value}`);
  }
  if ((isMap(node) || isSeq(node)) && !node.flow) {
    const holder = nodeAt(document, parent);
    const pair = isMap(holder) && typeof key === "string" ? pairOf(holder, key) : undefined;
    if (pair) return splice(text, ((pair.key as Node).range?.[1] ?? 0) + 1, endOf(node), ` ${value}`);
  }
  return splice(text, node.range[0], endOf(node), value);
}

/** The list at `path` with one more item. */
export function appendItem(text: string, path: ValuePath, value: string): string {
  const node = nodeAt(parseFile(text), path);
  if (isSeq(node) && node.items.length > 0) {
    const last = node.items.at(-1);
    if (node.flow) return splice(text, endOf(last), endOf(last), `, ${value}`);
    const first = lineStart(text, startOf(node.items[0]));
    const dash = text.indexOf("-", first);
    return insertLine(text, endOf(last), `${" ".repeat(dash - first)}- ${value}`);
  }
  if (path.length === 1) return openSection(text, String(path[0]), `- ${value}`);
  return setValue(text, path, `[${value}]`);
}

/** Without the entry or item at `path`, and without what held nothing else. */
export function removeAt(text: string, path: ValuePath): string {
  const document = parseFile(text);
  const holder = nodeAt(document, path.slice(0, -1));
  const key = path.at(-1);
  if (!isMap(holder) && !isSeq(holder)) return text;
  const index = indexOf(holder, key);
  if (index < 0) return text;
  if (holder.items.length === 1 && path.length > 1) return removeAt(text, path.slice(0, -1));
  const item: unknown = holder.items[index];
  if (!holder.flow) return splice(text, lineStart(text, startOf(item)), afterLine(text, endOf(item)), "");
  if (index + 1 < holder.items.length) return splice(text, startOf(item), startOf(holder.items[index + 1]), "");
  return splice(text, index > 0 ? endOf(holder.items[index - 1]) : startOf(item), endOf(item), "");
}

function indexOf(holder: YAMLMap | YAMLSeq, key: string | number | undefined): number {
  if (isSeq(holder)) return typeof key === "number" && key < holder.items.length ? key : -1;
  return holder.items.findIndex((pair) => isScalar(pair.key) && String(pair.key.value) === key);
}

/** What stands at a line and a column, both from 1 on: the path of the innermost entry there. */
export function pathAt(text: string, line: number, column: number): ValuePath {
  const lines = text.split("\n");
  return pathAtOffset(text, lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0) + column - 1);
}

/** The same by how many letters come before. */
export function pathAtOffset(text: string, place: number): ValuePath {
  const path: ValuePath = [];
  let node: unknown = parseFile(text).contents;
  for (;;) {
    if (!isMap(node) && !isSeq(node)) return path;
    const index = (node.items as unknown[]).findIndex((item) => startOf(item) <= place && place <= endOf(item));
    if (index < 0) return path;
    const item: unknown = node.items[index];
    path.push(isPair(item) && isScalar(item.key) ? String(item.key.value) : index);
    node = isPair(item) ? item.value : item;
  }
}

/** From where to where an entry stands, its key too. */
export function rangeAt(text: string, path: ValuePath): [number, number] | undefined {
  const holder = nodeAt(parseFile(text), path.slice(0, -1));
  if (!isMap(holder) && !isSeq(holder)) return undefined;
  const item: unknown = holder.items[indexOf(holder, path.at(-1))];
  return item === undefined ? undefined : [startOf(item), endOf(item)];
}
