// Loci, zones and workspace on a canvas, by the drawing rules of report/.
import type { ColourRole, Curve, CurveGroup, IsolatedPoint, ModeNames, Picture, Point, PointGroup, Theme, Zone } from "../data/answers";
import { sameMode } from "../data/answers";
import { page, type View } from "./view";

export function colourOf(theme: Theme, role: ColourRole): string {
  if (role === "singularity") return theme.singularity;
  if (role === "boundary") return theme.boundary;
  if (role === "margin") return theme.failed;
  return theme.curves[role % theme.curves.length] ?? theme.ink;
}

/** "c1, c4": the ids of a group's curves or surfaces; of many the first two and the last. */
export function idsOf(group: object): string {
  const ids = "ids" in group ? (group.ids as string[]) : [];
  return ids.length > 4 ? `${ids[0]}, ${ids[1]}, …, ${ids[ids.length - 1]}` : ids.join(", ");
}

/** What of a picture belongs to one working mode and is switched on. */
export interface Shown {
  curves: { curve: Curve; group: CurveGroup }[];
  points: { point: IsolatedPoint; group: PointGroup }[];
  rings: Point[][];
}

export function shownOf(picture: Picture, mode: ModeNames | undefined, hidden: ReadonlySet<string>): Shown {
  const own = (one: { working_mode: ModeNames }): boolean => mode === undefined || sameMode(one.working_mode, mode);
  const byId = new Map(picture.loci.curves.map((curve) => [curve.id, curve]));
  const shown: Shown = { curves: [], points: [], rings: [] };
  for (const group of picture.curve_groups) {
    if (hidden.has(groupKey(group))) continue;
    for (const id of group.ids) {
      const curve = byId.get(id);
      if (curve && own(curve)) shown.curves.push({ curve, group });
    }
  }
  for (const group of picture.point_groups) {
    if (hidden.has(groupKey(group))) continue;
    for (const index of group.points) {
      const point = picture.loci.isolated_points[index];
      if (point && own(point)) shown.points.push({ point, group });
    }
  }
  for (const region of picture.loci.workspace) if (own(region)) shown.rings.push(...region.rings);
  return shown;
}

/** By what a switch knows a group, whatever the design: what vanishes, not its number. */
export function groupKey(group: { kind: string; what: string; why?: string }): string {
  return `${group.kind}|${group.what}|${group.why ?? ""}`;
}

export function trace(context: CanvasRenderingContext2D, view: View, points: readonly Point[]): void {
  let first = true;
  for (const at of points) {
    const x = view.origin[0] + at[0] * view.scale[0];
    const y = view.origin[1] - at[1] * view.scale[1];
    if (first) context.moveTo(x, y);
    else context.lineTo(x, y);
    first = false;
  }
}

export function drawWorkspace(context: CanvasRenderingContext2D, view: View, rings: readonly Point[][], theme: Theme): void {
  context.beginPath();
  for (const ring of rings) trace(context, view, ring);
  context.fillStyle = theme.workspace;
  context.fill("evenodd");
}

export function drawZones(context: CanvasRenderingContext2D, view: View, zones: readonly Zone[], theme: Theme, stale: boolean): void {
  context.save();
  zones.forEach((zone, index) => {
    context.beginPath();
    for (const ring of zone.polygon) trace(context, view, ring);
    context.globalAlpha = theme.zone_strength * (stale ? 0.45 : 1);
    context.fillStyle = theme.zones[index % theme.zones.length] ?? theme.workspace;
    context.fill("evenodd");
  });
  context.restore();
}

export function drawZoneNames(context: CanvasRenderingContext2D, view: View, zones: readonly Zone[], theme: Theme): void {
  context.save();
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const zone of zones) {
    const at = page(view, zone.inscribed_circle.centre);
    const radius = zone.inscribed_circle.radius * view.scale[0];
    context.strokeStyle = theme.circle;
    context.globalAlpha = 0.55;
    context.lineWidth = 0.8;
    context.setLineDash([3, 3]);
    context.beginPath();
    context.arc(at[0], at[1], radius, 0, 2 * Math.PI);
    context.stroke();
    if (radius < 8) continue;
    context.globalAlpha = 0.85;
    context.font = "600 12px system-ui, sans-serif";
    context.fillStyle = theme.ink;
    context.fillText(zone.id, at[0], at[1]);
  }
  context.restore();
}

export interface LociStyle {
  /** 1: as in the pictures; a kept design is fainter. */
  strength: number;
  highlight?: string | undefined;
  /** Not yet: in short dashes, whatever the kind, and lighter. */
  proven?: boolean;
}

const unproven = { dash: [2.5, 3], strength: 0.6 };

/** Thin lines first, what matters most last. */
export function drawCurves(context: CanvasRenderingContext2D, view: View, shown: Shown, theme: Theme, style: LociStyle): void {
  context.save();
  context.lineJoin = "round";
  const strength = style.strength * (style.proven === false ? unproven.strength : 1);
  context.globalAlpha = strength;
  for (let k = shown.curves.length - 1; k >= 0; --k) {
    const entry = shown.curves[k];
    if (!entry) continue;
    const { curve, group } = entry;
    const wide = curve.id === style.highlight;
    context.lineCap = group.round && style.proven !== false ? "round" : "butt";
    context.beginPath();
    for (const arc of curve.arcs) trace(context, view, arc.points);
    if (wide) {
      context.setLineDash([]);
      context.lineWidth = group.width + 7;
      context.globalAlpha = 0.25 * strength;
      context.strokeStyle = colourOf(theme, group.colour);
      context.stroke();
      context.globalAlpha = strength;
    }
    // A dot is a dash without length under a round cap.
    context.setLineDash(style.proven === false ? unproven.dash : group.dash.map((length) => length * 1.15));
    context.lineWidth = group.width;
    context.strokeStyle = colourOf(theme, group.colour);
    context.stroke();
  }
  context.restore();
}

export function drawPoints(context: CanvasRenderingContext2D, view: View, shown: Shown, theme: Theme): void {
  context.save();
  for (const { point, group } of shown.points) {
    const at = page(view, [point.at[0] ?? 0, point.at[1] ?? 0]);
    drawMarker(context, at, group.shape, colourOf(theme, group.colour), theme);
  }
  context.restore();
}

export function drawMarker(context: CanvasRenderingContext2D, at: Point, shape: string, colour: string, theme: Theme): void {
  const r = 5.5;
  context.beginPath();
  if (shape === "square") context.rect(at[0] - r, at[1] - r, 2 * r, 2 * r);
  else if (shape === "diamond") polygon(context, at, [[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]], r);
  else if (shape === "triangle") polygon(context, at, [[0, -1.25], [1.1, 0.75], [-1.1, 0.75]], r);
  else context.arc(at[0], at[1], r, 0, 2 * Math.PI);
  context.fillStyle = theme.paper;
  context.fill();
  context.lineWidth = 1.8;
  context.strokeStyle = colour;
  context.setLineDash([]);
  context.stroke();
  context.beginPath();
  context.arc(at[0], at[1], 1.6, 0, 2 * Math.PI);
  context.fillStyle = theme.ink;
  context.fill();
}

function polygon(context: CanvasRenderingContext2D, at: Point, corners: Point[], r: number): void {
  corners.forEach(([x, y], index) => {
    if (index === 0) context.moveTo(at[0] + x * r, at[1] + y * r);
    else context.lineTo(at[0] + x * r, at[1] + y * r);
  });
  context.closePath();
}
