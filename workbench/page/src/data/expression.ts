// Expressions of a mechanism file as numbers, as far as a picture needs them: + - * / ^, parentheses, functions, units.

const functions: Record<string, (x: number) => number> = { sqrt: Math.sqrt, cos: Math.cos, sin: Math.sin, tan: Math.tan, atan: Math.atan, abs: Math.abs };

/** The value with these symbols, units among them; NaN where it says something else. */
export function evaluate(text: string, symbols: (name: string) => number | undefined): number {
  const tokens = text.match(/\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|[A-Za-z_]\w*|\S/g) ?? [];
  let next = 0;
  const take = (token: string): boolean => tokens[next] === token && ++next > 0;

  function atom(): number {
    const token = tokens[next++];
    if (token === undefined) return NaN;
    if (token === "(") {
      const inner = sum();
      return take(")") ? inner : NaN;
    }
    if (/^[\d.]/.test(token)) return Number(token);
    const applied = functions[token];
    if (applied && take("(")) {
      const inner = sum();
      return take(")") ? applied(inner) : NaN;
    }
    return symbols(token) ?? NaN;
  }
  function power(): number {
    const base = atom();
    return take("^") ? base ** signed() : base;
  }
  function signed(): number {
    if (take("-")) return -signed();
    return take("+") ? signed() : power();
  }
  function product(): number {
    let value = signed();
    for (;;) {
      if (take("*")) value *= signed();
      else if (take("/")) value /= signed();
      else if (/^[A-Za-z_]/.test(tokens[next] ?? "")) value *= power(); // a unit behind its number
      else return value;
    }
  }
  function sum(): number {
    let value = product();
    for (;;) {
      if (take("+")) value += product();
      else if (take("-")) value -= product();
      else return value;
    }
  }
  const value = sum();
  return next === tokens.length ? value : NaN;
}
