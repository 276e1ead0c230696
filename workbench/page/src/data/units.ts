// SI answers as people read them: in the units of their mechanism file, as the program's tables are.
import { shortNumber } from "./exact";

/** `size`: one of it in SI units, 0.001 of "mm". */
export interface Unit {
  name: string;
  size: number;
}

export interface Units {
  /** By the file; else lengths are in m, mm or µm, whichever reads best. */
  declared: boolean;
  length: Unit;
  angle: Unit;
  force: Unit;
}

const degree: Unit = { name: "deg", size: Math.PI / 180 };

export const siUnits: Units = { declared: false, length: { name: "m", size: 1 }, angle: degree, force: { name: "N", size: 1 } };

/** SI of one of each; what is no unit here is absent. */
export const unitSizes: Record<string, number> = { m: 1, dm: 0.1, cm: 0.01, mm: 1e-3, um: 1e-6, km: 1e3, in: 0.0254, rad: 1, mrad: 1e-3, deg: Math.PI / 180, N: 1, mN: 1e-3, kN: 1e3, MN: 1e6 };

/** By what a file says under `units`; what it does not say is m, deg and N. */
export function unitsOf(said: { length?: string | undefined; angle?: string | undefined; force?: string | undefined } | undefined): Units {
  const unit = (name: string | undefined, usual: Unit): Unit => (name !== undefined && unitSizes[name] ? { name, size: unitSizes[name] } : usual);
  if (!said) return siUnits;
  return { declared: true, length: unit(said.length, siUnits.length), angle: unit(said.angle, degree), force: unit(said.force, siUnits.force) };
}

/** Of a free coordinate. */
export function unitOf(units: Units, angle: boolean): Unit {
  return angle ? units.angle : units.length;
}

/** Of a length: "0.28 mm", "450 mm"; without a unit of the file "12 µm", "0.45 m". */
export function lengthWords(metres: number | null | undefined, units: Units): string {
  if (metres === null || metres === undefined || !Number.isFinite(metres)) return "unbounded";
  if (units.declared) return `${shortNumber(metres / units.length.size)} ${units.length.name}`;
  const size = Math.abs(metres);
  if (size === 0) return "0 m";
  if (size < 1e-3) return `${shortNumber(metres * 1e6, 3)} µm`;
  if (size < 0.1) return `${shortNumber(metres * 1e3, 3)} mm`;
  return `${shortNumber(metres, 4)} m`;
}

/** Of a small angle, as the rotation of the end effector by its clearances. */
export function turnWords(radians: number | null | undefined, units: Units): string {
  if (radians === null || radians === undefined || !Number.isFinite(radians)) return "unbounded";
  if (units.declared) return `${shortNumber(radians / units.angle.size)} ${units.angle.name}`;
  return `${shortNumber(radians * 1e3, 3)} mrad`;
}

/** In which errors of the pose are plotted: mm where the file says nothing. */
export function smallUnit(units: Units): Unit {
  return units.declared ? units.length : { name: "mm", size: 1e-3 };
}

export function areaWords(squareMetres: number, units: Units): string {
  return `${shortNumber(squareMetres / units.length.size ** 2)} ${units.length.name}²`;
}

/** Of a force or, with `couple`, of N m, which is not scaled. */
export function forceNumber(newtons: number | null | undefined, units: Units): string {
  return shortNumber(newtons === null || newtons === undefined ? newtons : newtons / units.force.size);
}

/** "(250, -700) mm"; where angles are among the coordinates "(250 mm, 30 deg)". */
export function placeWords(at: readonly number[], angles: readonly boolean[], units: Units): string {
  const told = at.map((value, k) => ({ words: shortNumber(value / unitOf(units, angles[k] ?? false).size), unit: unitOf(units, angles[k] ?? false).name }));
  const mixed = angles.some(Boolean);
  return `(${told.map((one) => (mixed ? `${one.words} ${one.unit}` : one.words)).join(", ")})${mixed ? "" : ` ${units.length.name}`}`;
}
