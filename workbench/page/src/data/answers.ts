// What the server answers, as docs/reference/results.md and report/viewer.hpp say.

import type { Units } from "./units";

export type Point = [number, number];

export interface Vanishing {
  joint: string;
  quantity: string;
}

export interface Arc {
  closed: boolean;
  length: number;
  points: Point[];
}

export type ModeNames = Record<string, string>;

export interface Curve {
  id: string;
  kind: string;
  vanishing: Vanishing[];
  factor: string;
  cause: string;
  implicit: { polynomial: string; degree: number } | null;
  closed_form: Record<string, unknown> | null;
  working_mode: ModeNames;
  certified: boolean;
  arcs: Arc[];
}

export interface Surface extends Omit<Curve, "arcs" | "closed_form"> {
  within_resolution: boolean;
  area: number;
}

export interface IsolatedPoint {
  kind: string;
  vanishing: Vanishing[];
  factor?: string;
  cause?: string;
  at: number[];
  certified: boolean;
  working_mode: ModeNames;
}

export interface Loci {
  mechanism: string;
  coordinates: string[];
  units?: string[];
  box: [number, number][];
  complete: boolean;
  /** Places at which a locus is not proven; over two coordinates. */
  open?: { cause: string; working_mode: ModeNames; from: number[]; to: number[] }[];
  curves: Curve[];
  surfaces?: Surface[];
  isolated_points: IsolatedPoint[];
  workspace: { working_mode: ModeNames; rings: Point[][] }[];
  reachable?: { working_mode: ModeNames; from: number; to: number }[];
  notes: string[];
}

/** "singularity", "boundary", or a place among a theme's curves. */
export type ColourRole = number | "singularity" | "boundary" | "margin";

export interface CurveGroup {
  kind: string;
  what: string;
  why: string;
  colour: ColourRole;
  width: number;
  dash: number[];
  round: boolean;
  ids: string[];
}

export interface PointGroup {
  kind: string;
  what: string;
  colour: ColourRole;
  shape: string;
  points: number[];
}

export interface SurfaceGroup {
  kind: string;
  what: string;
  why: string;
  colour: ColourRole;
  opacity: number;
  /** Surfaces, or curves on which a force of several components vanishes. */
  ids: string[];
  /** Places among the isolated points. */
  points: number[];
}

export interface Mesh {
  id: string;
  vertices: string;
  triangles: string;
}

export interface Picture {
  /** By which the server knows these loci again. */
  name?: string;
  /** That the server worked for them. */
  seconds?: number;
  loci: Loci;
  curve_groups: CurveGroup[];
  /** Reasons that several of them share. */
  remarks: string[];
  point_groups: PointGroup[];
  surface_groups: SurfaceGroup[];
  meshes: Mesh[];
  /** Those of the mechanism file, and the notes in them. */
  units: Units;
  notes: string[];
  parameters: { name: string; value: string }[];
  /** Of all modes; none where the page shows none. */
  zones: (Zone & { working_mode: ModeNames })[];
  sketches: { working_mode: ModeNames; sketch: Sketch }[];
}

export interface Sketch {
  links: { name: string; points: Point[] }[];
  slides: { from: Point; to: Point; rail: boolean }[];
  joints: { name: string; at: Point; on_ground: boolean; actuated: boolean }[];
  loads: { at: Point; force: Point; couple: number }[];
  springs?: { from: Point; to: Point; torsion: boolean; from_ground?: boolean; to_ground?: boolean }[];
  gravity: Point;
  /** The end effector's point. */
  end_effector?: { name: string; at: Point };
}

export interface Theme {
  paper: string;
  ink: string;
  faded_ink: string;
  frame: string;
  grid: string;
  workspace: string;
  outline: string;
  link: string;
  load: string;
  verified: string;
  failed: string;
  singularity: string;
  boundary: string;
  circle: string;
  curves: string[];
  zones: string[];
  zone_strength: number;
}

export interface Rules {
  themes: { light: Theme; dark: Theme };
  kinds: { kind: string; words: string; happens: string }[];
}

export interface Zone {
  id: string;
  area: number;
  inscribed_circle: { centre: Point; radius: number };
  certified: boolean;
  polygon: Point[][];
  contact_lost_at_border: string[];
}

export interface Zones {
  zones: Zone[];
  picture?: Picture;
}

export interface ModelFacts {
  name: string;
  spatial: boolean;
  pose_is_place: boolean;
  parameters: { name: string; exact: string; value: number }[];
  coordinates: { name: string; angle: boolean; lower: number; upper: number }[];
  joints: { name: string; type: string; actuated: boolean; clearance: boolean; from: string; to: string; at: string }[];
  links: { name: string; points: string[] }[];
  end_effector: { link: string; at: string };
  dyads: { point: string; left: string; right: string; side: number }[];
  sample: number[] | null;
  formats: { loci: string[]; zones: string[]; verification: string[] };
}

export interface TakeUp {
  dx?: number | null;
  dy?: number | null;
  dz?: number | null;
  beta?: number | null;
  dtheta?: number | null;
}

/** null: nothing ends it. */
export interface EffortRange {
  from: number | null;
  to: number | null;
  below: Vanishing[];
  above: Vanishing[];
}

export interface FeasibleEfforts {
  effort: number;
  within: [number, number] | null;
  ranges: EffortRange[];
  never: Vanishing[];
}

export interface Pose {
  at: number[];
  posture: Record<string, number[]>;
  reactions: Record<string, Record<string, number | null>>;
  determinant: number;
  condition: number | null;
  take_up: Record<string, TakeUp>;
  pose_error: Record<string, number | null> | null;
  undefined_take_up: string[];
  vanishing: Vanishing[];
  /** Of every free actuator, N m or N. */
  feasible_efforts?: Record<string, FeasibleEfforts>;
  singular: boolean;
  worst_case: Record<string, number | null>;
  unreachable: string;
  sketch?: Sketch;
}

export interface Verdict {
  verdict: "verified" | "refuted" | "undecided";
  verified: boolean;
  zone: string | null;
  margin: number | null;
  /** rad, of tasks over angles. */
  angle_margin?: number | null;
  nearest: { curve: string | null; kind: string; joints: string[]; at: number[]; distance: number } | null;
  witness: { at: number[]; reason: string; distance: number; design?: Record<string, number> } | null;
  /** The witness's reason in the units of the file. */
  reason_shown?: string;
  open: { reason: string; cells: number } | null;
  moved_by?: Point;
}

export interface Sweep {
  reactions: Record<string, { joint: string; quantity: string; unit: string; values: (number | null)[] }>;
  errors: ((number | null)[] | null)[];
  places: (number[] | null)[];
}

export interface Modes {
  modes: { mode: number[]; sample: number[] | null; sketch?: Sketch }[];
  dyads: number;
}

export interface Trajectory {
  trajectory: string;
  law: string;
  period: number;
  length: number;
  stages: { from: string; to: string; begins: number; ends: number; critical_period: number | null }[];
  contact_losses: { time: number; distance: number; joint: string; quantity: string; kind: string }[];
  samples: Record<string, (number | null)[]>;
}

export interface NamedText {
  name: string;
  text: string;
}

export interface Start {
  file: string;
  text: string;
  values: Record<string, string>;
  examples: NamedText[];
  companions: NamedText[];
  rules: Rules;
  time_limit: number;
}

/** Whether two working modes are the same: the same sides of the same points. */
export function sameMode(one: ModeNames, other: ModeNames): boolean {
  const names = Object.keys(one);
  return names.length === Object.keys(other).length && names.every((name) => one[name] === other[name]);
}

/** "f_A1", "M_A2". */
export function reactionName(reaction: Vanishing): string {
  return `${reaction.quantity}_${reaction.joint}`;
}
