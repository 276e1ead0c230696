// The numbers of a task's shape, to read and to type: of one that was drawn, and of one that a fit has moved.
import { parseExact, toNumber } from "../data/exact";
import { unitOf, type Unit } from "../data/units";
import { h, replace } from "./dom";
import type { TaskShape } from "./state";
import type { Workbench } from "./workbench";

/** `axis`: of the coordinate whose unit it has; none: a length. */
interface Entry {
  label: string;
  axis: number | undefined;
  value: number;
  with(value: number): TaskShape;
}

interface Row {
  name: string;
  axis: number | undefined;
  entries: Entry[];
}

function replaced<T>(list: readonly T[], index: number, value: T): T[] {
  return list.map((one, k) => (k === index ? value : one));
}

function pointRow(name: string, words: string, at: readonly [number, number], names: string[], make: (at: [number, number]) => TaskShape): Row {
  const entry = (axis: 0 | 1): Entry => ({ label: `${names[axis] ?? ""} of ${words}`, axis, value: at[axis], with: (value) => make(axis === 0 ? [value, at[1]] : [at[0], value]) });
  return { name, axis: 0, entries: [entry(0), entry(1)] };
}

/** A row a coordinate of a box, a point of another shape. */
export function rowsOf(shape: TaskShape, names: string[]): Row[] {
  switch (shape.kind) {
    case "box":
    case "ranges":
      return names.map((name, axis) => {
        const end = (which: "low" | "high", word: string): Entry => ({
          label: `${name} of the task, ${word}`,
          axis,
          value: shape[which][axis] ?? 0,
          with: (value) => ({ ...shape, [which]: replaced<number>(shape[which], axis, value) }),
        });
        return { name, axis, entries: [end("low", "from"), end("high", "to")] };
      });
    case "circle":
      return [
        pointRow("centre", "the centre", shape.centre, names, (centre) => ({ ...shape, centre })),
        { name: "radius", axis: undefined, entries: [{ label: "radius of the task", axis: undefined, value: shape.radius, with: (radius) => ({ ...shape, radius }) }] },
      ];
    default:
      return shape.points.map((at, k) => pointRow(`point ${k + 1}`, `point ${k + 1}`, at, names, (to) => ({ ...shape, points: replaced(shape.points, k, to) })));
  }
}

/** Fields for all of them. While one is typed in, the others wait. */
export function showNumbers(parent: HTMLElement, bench: Workbench): void {
  const shape = bench.state.task?.shape;
  if (!shape) return replace(parent);
  if (parent.contains(document.activeElement)) return;
  const names = bench.coordinates.map((one) => one.name);
  const unit = (axis: number | undefined): Unit => unitOf(bench.units, axis !== undefined && (bench.coordinates[axis]?.angle ?? false));
  const field = (row: number, column: number, entry: Entry): HTMLInputElement => {
    const { size } = unit(entry.axis);
    const input = h("input", { type: "text", class: "exact", "aria-label": entry.label, autocomplete: "off", value: String(Number((entry.value / size).toPrecision(7))) });
    input.addEventListener("change", () => {
      const typed = parseExact(input.value);
      input.setAttribute("aria-invalid", String(!typed));
      const { task } = bench.state; // another field may have changed it since
      const now = task && rowsOf(task.shape, names)[row]?.entries[column];
      if (typed && task && now) bench.change({ task: { ...task, shape: now.with(Number((toNumber(typed) * size).toPrecision(15))) } });
    });
    return input;
  };
  replace(
    parent,
    ...rowsOf(shape, names).map((row, k) => {
      const fields = row.entries.map((entry, column) => field(k, column, entry));
      return h("div", { class: "range-row" }, h("span", { class: "value-name" }, row.name), ...fields, ...(fields.length < 2 ? [h("span", {})] : []), h("span", { class: "unit" }, unit(row.axis).name));
    }),
  );
}
