// Another name for an element, everywhere in its file: in lists, in formulas, in the keys of lengths.
import { isMap, isPair, isScalar, isSeq, type Scalar } from "yaml";
import { parseFile, type ValuePath } from "../data/file_text";
import type { Drawing } from "./drawing";
import type { Edit } from "./edit";

export type Named = "point" | "link" | "joint" | "coordinate" | "parameter";

interface Word {
  path: ValuePath;
  node: Scalar;
  key: boolean;
}

/** Every scalar of the file, keys too, with where it stands; of copies of a pattern as if they stood in the file itself. */
function wordsOf(text: string): Word[] {
  const words: Word[] = [];
  const walk = (node: unknown, path: ValuePath): void => {
    if (isScalar(node)) words.push({ path, node, key: false });
    else if (isSeq(node)) node.items.forEach((item, k) => walk(item, [...path, k]));
    else if (isMap(node))
      for (const pair of node.items) {
        if (!isPair(pair) || !isScalar(pair.key)) continue;
        const own = [...path, String(pair.key.value)];
        words.push({ path: own, node: pair.key, key: true });
        walk(pair.value, own);
      }
  };
  walk(parseFile(text).contents, []);
  return words;
}

const sections: Record<Named, string[]> = { point: ["drawn", "points"], link: ["links"], joint: ["joints"], coordinate: ["workspace"], parameter: ["parameters"] };
const types = ["revolute", "prismatic", "universal", "spherical", "cylindrical", "slot", "gear", "belt", "cable"];

/** What a value that is a plain name names at this place; elsewhere it is a point, or a formula. */
function namedAt(path: ValuePath, drawing: Drawing): "link" | "joint" | "text" | "formula" {
  const [section, name, key] = path;
  const last = path.findLast((one) => typeof one === "string");
  if (section === "name" || section === "units" || section === "space" || section === "format" || last === "name" || last === "side") return "text";
  if (section === "joints") return types.includes(String(key)) ? "link" : "formula";
  if (last === "link" || last === "links" || last === "relative_to") return "link";
  if (section === "springs" && last === "joint") return "joint";
  if (section === "workspace" && key === "of") {
    const own = drawing.coordinates.find((one) => one.name === name);
    return own?.kind === "stroke" ? "joint" : own?.kind === "place" ? "formula" : "link";
  }
  return "formula";
}

/** Why an element cannot have another name. */
export function renameFault(drawing: Drawing, kind: Named, from: string, to: string): string | undefined {
  if (!/^[A-Za-z]\w*$/.test(to)) return `'${to}' is no name: write a letter, then letters, digits or _`;
  if (/^null$/i.test(to)) return `'${to}' means nothing in a mechanism file`;
  const symbols = [...drawing.coordinates, ...drawing.parameters, ...drawing.points];
  const taken = kind === "link" || kind === "joint" ? listsOf(drawing)[kind] : symbols;
  return to !== from && taken.some((one) => one.name === to) ? `'${to}' is the name of another one` : undefined;
}

function listsOf(drawing: Drawing): Record<Named, { name: string }[]> {
  return { point: drawing.points, link: [...drawing.links, { name: "ground" }], joint: [...drawing.joints, ...drawing.ties], coordinate: drawing.coordinates, parameter: drawing.parameters };
}

/** Nothing where the name is taken or is none. */
export function rename(drawing: Drawing, kind: Named, from: string, to: string): Edit {
  if (to === from || renameFault(drawing, kind, from, to) !== undefined || !listsOf(drawing)[kind].some((one) => one.name === from)) return undefined;
  const word = new RegExp(`(?<![\\w.])${from}(?!\\w)`, "g");
  const changed = wordsOf(drawing.text).flatMap(({ path, node, key }) => {
    const { range } = node;
    if (!range) return [];
    const text = drawing.text.slice(range[0], range[1]);
    const is = (): boolean => {
      if (key) return path.length === 2 ? sections[kind].includes(String(path[0])) && path[1] === from : kind === "point" && path.includes("lengths");
      const named = namedAt(path, drawing);
      if (kind === "link" || kind === "joint") return named === kind && String(node.value) === from;
      return named === "formula";
    };
    const put = is() ? text.replace(word, to) : text;
    return put === text ? [] : [{ from: range[0], to: range[1], put }];
  });
  return changed.reverse().reduce((text, one) => text.slice(0, one.from) + one.put + text.slice(one.to), drawing.text);
}
