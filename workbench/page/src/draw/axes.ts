// Grid, frame and numbers around the plane.
import type { Theme } from "../data/answers";
import type { Unit } from "../data/units";
import { page, plane, ticks, tickText, type Box, type Size, type View } from "./view";

export interface AxisNames {
  names: [string, string];
  units: [Unit, Unit];
}

export function drawGrid(context: CanvasRenderingContext2D, view: View, size: Size, axes: AxisNames, theme: Theme): void {
  const low = plane(view, [0, size.height]);
  const high = plane(view, [size.width, 0]);
  context.save();
  context.strokeStyle = theme.grid;
  context.fillStyle = theme.faded_ink;
  context.lineWidth = 1;
  context.font = "11px system-ui, sans-serif";
  context.beginPath();
  const xs = ticks(low[0], high[0], view.scale[0], 80, axes.units[0]);
  const ys = ticks(low[1], high[1], view.scale[1], 60, axes.units[1]);
  for (const x of xs) {
    const at = Math.round(page(view, [x, 0])[0]) + 0.5;
    context.moveTo(at, 0);
    context.lineTo(at, size.height);
  }
  for (const y of ys) {
    const at = Math.round(page(view, [0, y])[1]) + 0.5;
    context.moveTo(0, at);
    context.lineTo(size.width, at);
  }
  context.stroke();
  context.textAlign = "center";
  context.textBaseline = "bottom";
  for (const x of xs) {
    const [at] = page(view, [x, 0]);
    const text = tickText(x, axes.units[0]);
    const half = context.measureText(text).width / 2;
    if (at > half + 2 && at < size.width - half - 2) context.fillText(text, at, size.height - 3); // whole, or not at all
  }
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const y of ys) {
    const at = page(view, [0, y])[1];
    if (at < size.height - 22 && at > 28) // below the name of the axis
      context.fillText(tickText(y, axes.units[1]), 4, at);
  }
  context.font = "italic 12px system-ui, sans-serif";
  context.fillStyle = theme.ink;
  const unit = (axis: 0 | 1): string => `${axes.names[axis]} (${axes.units[axis].name})`;
  context.textAlign = "right";
  context.textBaseline = "bottom";
  context.fillText(unit(0), size.width - 6, size.height - 18);
  context.textAlign = "left";
  context.textBaseline = "top";
  context.fillText(unit(1), 6, 6);
  context.restore();
}

/** The searched box, dotted. */
export function drawBox(context: CanvasRenderingContext2D, view: View, box: Box, theme: Theme): void {
  const from = page(view, [box.low[0], box.high[1]]);
  const to = page(view, [box.high[0], box.low[1]]);
  context.save();
  context.strokeStyle = theme.frame;
  context.globalAlpha = 0.7;
  context.setLineDash([2, 3]);
  context.strokeRect(from[0], from[1], to[0] - from[0], to[1] - from[1]);
  context.restore();
}
