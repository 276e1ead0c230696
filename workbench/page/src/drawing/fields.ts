// What is typed on the thing itself: of every element its numbers, and what becomes of them.
import { removeAt, setValue, typed, wordAt, type ValuePath } from "../data/file_text";
import { shortNumber } from "../data/exact";
import { carriers, placeOf, type Drawing, type DrawnJoint, type DrawnTie } from "./drawing";
import { again, setMass, toggleMotor, writtenCoordinates, type Edit } from "./edit";
import type { Element } from "./element";
import { removeElement } from "./remove";
import { rename, renameFault } from "./rename";

/** What its name is; nothing where it has none. */
export function nameField(drawing: Drawing, element: Element): Field | undefined {
  if (!("name" in element)) return undefined;
  const { kind, name } = element;
  return { label: "name", text: name, hint: "", unit: "", write: (text) => rename(drawing, kind, name, text.trim()), fault: (text) => renameFault(drawing, kind, name, text.trim()) };
}

export interface Field {
  label: string;
  /** As written; empty where the file says nothing. */
  text: string;
  /** Shown where nothing is written. */
  hint: string;
  unit: string;
  write: (text: string) => Edit;
  /** Why a text cannot be written. */
  fault?: (text: string) => string | undefined;
}

function field(drawing: Drawing, label: string, path: ValuePath, unit: string, hint = ""): Field {
  return {
    label,
    text: wordAt(drawing.text, path) ?? "",
    hint,
    unit,
    write: (text) => (text.trim() === "" ? removeAt(drawing.text, path) : setValue(drawing.text, path, typed(text.trim()))),
  };
}

export function fieldsOf(drawing: Drawing, element: Element): Field[] {
  const length = drawing.units.declared ? drawing.units.length.name : "m";
  const force = drawing.units.declared ? drawing.units.force.name : "N";
  switch (element.kind) {
    case "point":
      return pointFields(drawing, element.name, length);
    case "link":
      return linkFields(drawing, element.name, length);
    case "joint": {
      const joint = drawing.joints.find((one) => one.name === element.name);
      const tie = drawing.ties.find((one) => one.name === element.name);
      return joint ? jointFields(drawing, joint, length) : tie ? tieFields(drawing, tie, length, force) : [];
    }
    case "load":
      return ["fx", "fy"].map((label, axis) => field(drawing, label, ["loads", element.index, "force", axis], force));
    case "spring":
      return [field(drawing, "stiffness", ["springs", element.index, "stiffness"], /[A-Za-z]/.test(wordAt(drawing.text, ["springs", element.index, "stiffness"]) ?? "") ? "" : "N/m"), field(drawing, "free length", ["springs", element.index, "free_length"], length, "0"), field(drawing, "force", ["springs", element.index, "force"], force, "by stiffness")];
    case "coordinate":
      return coordinateFields(drawing, element.name, length);
  }
}

function pointFields(drawing: Drawing, name: string, length: string): Field[] {
  const point = drawing.points.find((one) => one.name === name);
  const own = point?.fixed ? ["x", "y"].map((label, axis) => field(drawing, label, [point.section, name, axis], length)) : [];
  return [...own, ...drawing.joints.filter((joint) => joint.at === name).flatMap((joint) => jointFields(drawing, joint, length))];
}

/** "20e-6" or a fit with its diameter, "H7/g6 12". */
export function jointFields(drawing: Drawing, joint: DrawnJoint, length: string): Field[] {
  const path = ["joints", joint.name, "clearance"];
  if (joint.type === "prismatic") return joint.actuated ? [field(drawing, `${joint.name} axial clearance`, [...path, "axial"], length, "none")] : [field(drawing, `${joint.name} gap`, [...path, "gap"], length, "none")];
  if (joint.type === "slot") return [field(drawing, `${joint.name} gap`, [...path, "gap"], length, "none")];
  const fit = wordAt(drawing.text, [...path, "fit"]);
  const radial = field(drawing, `${joint.name} clearance`, [...path, "radial"], length, "none, or H7/g6 12");
  if (fit !== undefined) radial.text = `${fit} ${wordAt(drawing.text, [...path, "diameter"]) ?? ""}`;
  const { write } = radial;
  radial.write = (text) => {
    const [, named, diameter] = /^\s*([A-Z]\w*\/[a-z]\w*)\s+(.+?)\s*$/.exec(text) ?? [];
    const bare = fit === undefined ? drawing.text : removeAt(removeAt(drawing.text, [...path, "diameter"]), [...path, "fit"]);
    if (named === undefined || diameter === undefined) return fit === undefined ? write(text) : text.trim() === "" ? bare : setValue(bare, [...path, "radial"], typed(text.trim()));
    return setValue(setValue(removeAt(bare, [...path, "radial"]), [...path, "fit"], named), [...path, "diameter"], typed(diameter));
  };
  return [radial];
}

function tieFields(drawing: Drawing, tie: DrawnTie, length: string, force: string): Field[] {
  const path = ["joints", tie.name];
  if (tie.type === "cable") return ["least tension", "most tension"].map((label, k) => field(drawing, label, [...path, "tension", k], unitless(drawing, [...path, "tension", k], force)));
  const backlash = field(drawing, "backlash", [...path, "clearance", "backlash"], length, "none");
  if (tie.type === "gear") return [...[tie.from, tie.to].map((wheel, k) => field(drawing, `teeth of ${wheel}`, [...path, "teeth", k], "")), backlash];
  const radii = [tie.from, tie.to].map((pulley, k) => field(drawing, `radius of ${pulley}`, [...path, "radii", k], length));
  return [...radii, field(drawing, "tension", [...path, "tension"], unitless(drawing, [...path, "tension"], force)), backlash];
}

/** The unit beside a number that has none of its own. */
const unitless = (drawing: Drawing, path: ValuePath, unit: string): string => (/[A-Za-z]/.test(wordAt(drawing.text, path) ?? "") ? "" : unit);

function linkFields(drawing: Drawing, name: string, length: string): Field[] {
  const link = drawing.links.find((one) => one.name === name);
  if (!link) return [];
  const [a, b] = link.points.map((point) => placeOf(drawing, point));
  const drawn = a && b ? shortNumber(Math.hypot(b[0] - a[0], b[1] - a[1]) / drawing.metres, 6) : "";
  const isDrawn = link.points.every((point) => drawing.points.find((one) => one.name === point)?.section === "drawn");
  const mass = field(drawing, "mass", ["links", name, "mass"], "kg", "none");
  return [
    ...(link.points.length === 2 && isDrawn ? [field(drawing, "length", ["links", name, "length"], length, drawn)] : []),
    { ...mass, write: (text) => (text.trim() === "" ? removeAt(drawing.text, ["links", name, "mass"]) : setMass(drawing, name, typed(text.trim()))) },
  ];
}

function coordinateFields(drawing: Drawing, name: string, length: string): Field[] {
  const base = drawing.coordinates.find((one) => one.name === name)?.range ? drawing : again(drawing, writtenCoordinates(drawing));
  const own = base.coordinates.find((one) => one.name === name);
  const range = own?.range;
  if (!own || !range) return [];
  const unit = own.kind === "angle" ? (wordAt(base.text, ["units", "angle"]) ?? "rad") : length;
  return ["from", "to"].map((label, end) => field(base, `${name} ${label}`, [...range, end], unit));
}

/** Buttons beside the fields: what an element is or is not. */
export interface Switch {
  label: string;
  on: boolean;
  flip: () => Edit;
}

export function switchesOf(drawing: Drawing, element: Element): Switch[] {
  const joints = element.kind === "joint" ? drawing.joints.filter((one) => one.name === element.name) : element.kind === "point" ? drawing.joints.filter((one) => one.at === element.name) : [];
  return joints
    .filter((one) => one.type === "revolute" || one.type === "prismatic")
    .flatMap((joint) => {
      const between = `${joint.from}–${joint.to}`;
      const motor = { label: `motor ${joint.name} (${between})`, on: joint.actuated, flip: () => toggleMotor(drawing, joint.name) };
      return joint.type === "revolute" ? [motor, { label: `pin ${joint.name} (${between})`, on: true, flip: () => removeElement(drawing, { kind: "joint", name: joint.name }) }] : [motor];
    });
}

/** What it is, in words. */
export function titleOf(drawing: Drawing, element: Element): string {
  switch (element.kind) {
    case "point": {
      const links = carriers(drawing, element.name).map((one) => one.name);
      return `Point ${element.name}${links.length > 0 ? ` of ${links.join(", ")}` : ", on the ground"}`;
    }
    case "load":
      return `Load at ${drawing.loads[element.index]?.at ?? ""} on ${drawing.loads[element.index]?.link ?? ""}`;
    case "spring":
      return `Spring ${drawing.springs[element.index]?.at.join("–") ?? ""}`;
    case "joint": {
      const tie = drawing.ties.find((one) => one.name === element.name);
      return tie ? `${tie.type[0]?.toUpperCase() ?? ""}${tie.type.slice(1)} ${tie.name} (${tie.from}–${tie.to})` : `Joint ${element.name}`;
    }
    default:
      return `${element.kind[0]?.toUpperCase() ?? ""}${element.kind.slice(1)} ${element.name}`;
  }
}
