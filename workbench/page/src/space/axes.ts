// Ticks and names along three edges of the box: numbers as small pictures that face the eye.
import { BufferGeometry, CanvasTexture, Group, LineBasicMaterial, LineSegments, Sprite, SpriteMaterial, Vector3 } from "three";
import type { Theme } from "../data/answers";
import { unitOf, type Units } from "../data/units";
import { ticks, tickText } from "../draw/view";

export interface Axis {
  name: string;
  unit: string;
  /** Places along the coordinate, and what stands there. */
  ticks: { at: number; text: string }[];
}

/** Of about four numbers each. */
export function axesIn(units: Units, coordinates: readonly { name: string; lower: number; upper: number; angle: boolean }[]): Axis[] {
  return coordinates.map(({ name, lower, upper, angle }) => {
    const unit = unitOf(units, angle);
    return { name, unit: unit.name, ticks: ticks(lower, upper, 4 / (upper - lower), 1, unit).map((at) => ({ at, text: tickText(at, unit) })) };
  });
}

const pixels = 40; // of a line of letters; drawn at a third of it

function label(text: string, colour: string, height: number): Sprite {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const font = `600 ${pixels * 0.7}px system-ui, sans-serif`;
  if (context) context.font = font;
  canvas.width = Math.ceil((context?.measureText(text).width ?? pixels) + 8);
  canvas.height = pixels;
  if (context) {
    context.font = font; // a canvas of another size has forgotten it
    context.fillStyle = colour;
    context.textBaseline = "middle";
    context.fillText(text, 4, pixels / 2);
  }
  const sprite = new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), depthTest: false, transparent: true }));
  sprite.scale.set((height * canvas.width) / canvas.height, height, 1);
  sprite.renderOrder = 4;
  return sprite;
}

/** `low`, `high`: corners of the box as drawn; `place`: where a value along a coordinate lies between them. */
export function axesOf(axes: readonly Axis[], low: Vector3, high: Vector3, place: (axis: number, at: number) => number, theme: Theme): Group {
  const group = new Group();
  const points: Vector3[] = [];
  // Each beside the edge that faces the eye at first: x and y below in front, z upright on the left.
  const starts = [new Vector3(low.x, low.y, low.z), new Vector3(high.x, low.y, low.z), new Vector3(low.x, low.y, low.z)];
  const away = [new Vector3(0, -1, 0), new Vector3(1, 0, 0), new Vector3(-0.7, -0.7, 0)];
  axes.forEach((axis, k) => {
    const start = starts[k];
    const out = away[k];
    if (!start || !out) return;
    for (const tick of axis.ticks) {
      const at = start.clone().setComponent(k, place(k, tick.at));
      points.push(at, at.clone().addScaledVector(out, 0.03));
      const sprite = label(tick.text, theme.faded_ink, 0.06);
      sprite.position.copy(at.clone().addScaledVector(out, 0.1));
      group.add(sprite);
    }
    const name = label(axis.unit ? `${axis.name} (${axis.unit})` : axis.name, theme.ink, 0.075);
    // Beside the upright edge a name stands clear of the numbers, however long it is.
    const far = k === 2 ? 0.16 + name.scale.x / 2 : 0.24;
    name.position.copy(start.clone().setComponent(k, (low.getComponent(k) + high.getComponent(k)) / 2).addScaledVector(out, far));
    group.add(name);
  });
  group.add(new LineSegments(new BufferGeometry().setFromPoints(points), new LineBasicMaterial({ color: theme.frame })));
  return group;
}
