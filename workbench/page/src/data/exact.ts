// Exact numbers as they are typed and written in the mechanism file: "7/20", "0.35", "10e-6", "-3".

export interface Exact {
  top: bigint;
  below: bigint;
}

function gcd(a: bigint, b: bigint): bigint {
  return b === 0n ? (a < 0n ? -a : a) : gcd(b, a % b);
}

function reduced(top: bigint, below: bigint): Exact {
  const common = gcd(top, below) || 1n;
  return { top: top / common, below: below / common };
}

/** Nothing where the text is no plain number: an expression such as "2*L" or "30 deg". */
export function parseExact(text: string): Exact | undefined {
  const fraction = /^\s*([+-]?\d+)\s*\/\s*(\d+)\s*$/.exec(text);
  if (fraction) {
    const below = BigInt(fraction[2] ?? "1");
    return below === 0n ? undefined : reduced(BigInt(fraction[1] ?? "0"), below);
  }
  const decimal = /^\s*([+-]?)(\d*)\.?(\d*)(?:[eE]([+-]?\d{1,3}))?\s*$/.exec(text);
  if (!decimal || (decimal[2] === "" && decimal[3] === "")) return undefined;
  if (/\.\S*\./.test(text)) return undefined;
  const digits = BigInt(`${decimal[2] ?? ""}${decimal[3] ?? ""}` || "0");
  const power = Number(decimal[4] ?? "0") - (decimal[3] ?? "").length;
  const sign = decimal[1] === "-" ? -1n : 1n;
  const scale = 10n ** BigInt(Math.abs(power));
  return power >= 0 ? reduced(sign * digits * scale, 1n) : reduced(sign * digits, scale);
}

export function toNumber(value: Exact): number {
  const exact = Number(value.top) / Number(value.below);
  if (Number.isFinite(exact)) return exact;
  return Number((value.top * 10n ** 20n) / value.below) / 1e20;
}

/** "7/20". */
export function toText(value: Exact): string {
  return value.below === 1n ? value.top.toString() : `${value.top}/${value.below}`;
}

/** A value that the hand reached, on a grid of round decimals about as fine as `step`: "0.35", "-12", "15e-6". */
export function roundText(value: number, step: number): string {
  const power = Math.floor(Math.log10(Math.abs(step) || 1) + 1e-9);
  if (power >= 0) return String(Math.round(value / 10 ** power) * 10 ** power);
  const places = Math.min(-power, 15);
  const fixed = value.toFixed(places);
  if (places > 4 && Math.abs(value) < 1e-2) {
    const size = Math.abs(Number(fixed));
    if (size === 0) return "0";
    const exponent = Math.floor(Math.log10(size) / 3) * 3;
    const digits = Number((Number(fixed) * 10 ** -exponent).toFixed(Math.max(0, places + exponent)));
    return `${digits}e${exponent}`;
  }
  return fixed.includes(".") ? fixed.replace(/\.?0+$/, "") || "0" : fixed;
}

/** A number for people: `digits` significant ones, no trailing zeros. */
export function shortNumber(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-4) return value.toExponential(Math.max(0, digits - 1)).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(digits)));
}

/** "x^2 - 1/2*x*y" as LaTeX: "x^{2} - \frac{1}{2} x y". */
export function toLatex(polynomial: string): string {
  return polynomial
    .replace(/(\d+)\/(\d+)/g, "\\frac{$1}{$2}")
    .replace(/\^(\d+)/g, "^{$1}")
    .replace(/\b(cos|sin|tan)\(/g, "\\$1(")
    .replace(/\*/g, " ")
    .replace(/([a-zA-Z]+)(\d+)\b/g, "$1_{$2}");
}
