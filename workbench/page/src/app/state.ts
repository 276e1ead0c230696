// Everything that a link shows a colleague: the design, the pose, what is switched on. Undo walks through its past.

export type TaskShape =
  | { kind: "box"; low: [number, number]; high: [number, number] }
  | { kind: "circle"; centre: [number, number]; radius: number }
  | { kind: "polygon" | "path"; points: [number, number][] }
  /** Over other than two coordinates: a box of one range each. */
  | { kind: "ranges"; low: number[]; high: number[] };

export interface TaskState {
  shape: TaskShape;
  /** As typed: m, N, N m; empty: not asked. */
  margin: string;
  minForce: string;
  minCouple: string;
  /** Loads between two, "[[-20, -100], [20, -100]]"; empty: the file's. */
  loads: string;
  /** What may differ from the design, "L: 0.1e-3, d: [-0.2e-3, 0.1e-3]"; empty: nothing. */
  tolerances: string;
  /** What may come on top of the loads, "{load: 1, radius: 20}"; empty: nothing. */
  loadsWithin: string;
}

export const noDemands: Omit<TaskState, "shape"> = { margin: "", minForce: "", minCouple: "", loads: "", tolerances: "", loadsWithin: "" };

export interface State {
  file: string;
  text: string;
  /** +1 or -1 a dyad; nothing: the file's. */
  mode: number[] | undefined;
  at: number[] | undefined;
  /** Groups of loci that are switched off. */
  hidden: string[];
  /** Joints and quantities that count; nothing: all with a clearance, f and M. */
  joints: string[] | undefined;
  quantities: string[] | undefined;
  /** Efforts of free actuators, N m or N, as typed; of others the one next to zero. */
  preload: Record<string, string>;
  zones: boolean;
  reactions: boolean;
  takeUp: boolean;
  task: TaskState | undefined;
  kept: { text: string; mode: number[] | undefined; preload?: Record<string, string> } | undefined;
  trajectory: string | undefined;
  slice: { axis: number; at: number; on: boolean } | undefined;
  /** Whether the mechanism itself is drawn, with tools. */
  drawing: boolean;
}

export function freshState(file: string, text: string): State {
  return {
    file,
    text,
    mode: undefined,
    at: undefined,
    hidden: [],
    joints: undefined,
    quantities: undefined,
    preload: {},
    zones: true,
    reactions: true,
    takeUp: true,
    task: undefined,
    kept: undefined,
    trajectory: undefined,
    slice: undefined,
    drawing: false,
  };
}

/** Steps of one gesture (a drag, a slider's way) are one step of undo. */
export class History {
  private past: State[] = [];
  private future: State[] = [];
  private gesture: string | undefined;

  constructor(public present: State) {}

  set(next: State, gesture?: string): void {
    if (gesture === undefined || gesture !== this.gesture) {
      this.past.push(this.present);
      if (this.past.length > 500) this.past.shift();
    }
    this.gesture = gesture;
    this.future = [];
    this.present = next;
  }

  /** The next change is a step of its own, whatever it changes. */
  endGesture(): void {
    this.gesture = undefined;
  }

  /** Back to before the gesture; there is nothing to redo. */
  cancelGesture(): void {
    if (this.gesture === undefined) return;
    this.undo();
    this.future = [];
  }

  /** What follows from the state, such as a first pose: no step of its own. */
  amend(next: State): void {
    this.present = next;
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  undo(): void {
    const before = this.past.pop();
    if (!before) return;
    this.future.push(this.present);
    this.present = before;
    this.gesture = undefined;
  }

  redo(): void {
    const after = this.future.pop();
    if (!after) return;
    this.past.push(this.present);
    this.present = after;
    this.gesture = undefined;
  }
}
