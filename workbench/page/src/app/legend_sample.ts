// A piece of a curve for the legend.
import type { CurveGroup, PointGroup, SurfaceGroup, Theme } from "../data/answers";
import { colourOf, drawMarker } from "../draw/loci";
import { h } from "./dom";

export function legendSample(group: CurveGroup | PointGroup | SurfaceGroup, theme: Theme): HTMLCanvasElement {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [44, 16];
  const canvas = h("canvas", { width: width * ratio, height: height * ratio, class: "sample", "aria-hidden": "true" });
  const context = canvas.getContext("2d");
  if (!context) return canvas;
  context.scale(ratio, ratio);
  const colour = colourOf(theme, group.colour);
  if ("shape" in group) {
    drawMarker(context, [width / 2, height / 2], group.shape, colour, theme);
  } else if ("opacity" in group) {
    context.globalAlpha = group.opacity;
    context.fillStyle = colour;
    context.fillRect(2, 2, width - 4, height - 4);
  } else {
    context.lineWidth = group.width;
    context.strokeStyle = colour;
    context.lineCap = group.round ? "round" : "butt";
    context.setLineDash(group.dash.map((length) => length * 1.15));
    context.beginPath();
    context.moveTo(2, height / 2);
    context.lineTo(width - 2, height / 2);
    context.stroke();
  }
  return canvas;
}
