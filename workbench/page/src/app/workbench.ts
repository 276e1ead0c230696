// The one place where a change of the state becomes questions, and answers become what is drawn.
import type { ModelFacts, Modes, Picture, Pose, Rules, Start, Sweep, Theme, Trajectory, Verdict, Zones } from "../data/answers";
import { parseExact, toNumber } from "../data/exact";
import { pathAt, type ValuePath } from "../data/file_text";
import { ModelText, usualEffort, type Adjustable, type FreeEffort } from "../data/model_text";
import { drawingOf, drawnPose, type Drawing } from "../drawing/drawing";
import { missingIn, type Missing } from "../drawing/missing";
import { toHash } from "./address";
import { ask, AskingError, Following, type Fault } from "./asking";
import { freshState, History, type State, type TaskState } from "./state";
import { taskText } from "./task_text";
import type { Units } from "../data/units";

/** An error beside the field that caused it; without one, above the picture. */
export interface ShownFault {
  message: string;
  field: string | undefined;
  /** What stands there in the file; empty where it is about the whole. */
  path: ValuePath;
}

export type Answer = "model" | "loci" | "zones" | "pose" | "verify" | "modes" | "kept" | "sweep" | "trajectory";

/** The state that `lociQuestion` puts together: loci, zones and verdict are asked again where any of it changes. */
const lociQuestionOf = ["file", "text", "mode", "joints", "quantities", "preload"] as const;

export class Workbench {
  readonly history: History;
  rules: Rules;
  dark = false;
  model: ModelText;
  facts: ModelFacts | undefined;
  picture: Picture | undefined;
  /** Whether the picture is the server's last word; else its loci are carried over from the last design. */
  proven = true;
  /** What stays where the next design is refused. */
  private lastProven: Picture | undefined;
  zones: Zones | undefined;
  zonesStale = false;
  pose: Pose | undefined;
  private designOfPose = "";
  modes: Modes | undefined;
  verdict: Verdict | undefined;
  kept: Picture | undefined;
  sweep: { coordinate: number[]; answer: Sweep } | undefined;
  trajectory: Trajectory | undefined;
  fault: ShownFault | undefined;
  /** Of a mechanism that is being drawn: why there is nothing to ask yet. */
  missing: Missing | undefined;
  poseFault: string | undefined;
  taskFault: string | undefined;
  zonesFault: string | undefined;
  trajectoryFault: string | undefined;
  progress: { fraction: number; stage: string } | undefined;
  /** The field that the hand changed last. */
  private touched: string | undefined;
  /** The last file that was not refused: plain numbers keep its units, not that of a value that was refused. */
  private accepted: ModelText;
  private watchers: ((what: Set<string>) => void)[] = [];
  private news = new Set<string>();
  private factsStale = false;
  private frame = 0;
  private hashTimer: ReturnType<typeof setTimeout> | undefined;
  private quietTimer: ReturnType<typeof setTimeout> | undefined;
  private moves: { name: string; made: number }[] = [];
  /** What the server said of its own work, for bench/workbench. */
  private markServer(name: string, picture: Picture): void {
    const end = performance.now();
    performance.measure(`clearloci-${name}-server`, { start: Math.max(0, end - 1000 * (picture.seconds ?? 0)), end });
  }

  private readonly lanes = {
    model: new Following<ModelFacts>("model", (facts) => this.onModel(facts), (fault) => this.onFault(fault)),
    loci: new Following<Picture>("loci", (picture, made) => this.onLoci(picture, made), (fault) => this.onFault(fault), {
      from: () => (this.picture?.name !== undefined ? { last: this.picture.name } : {}),
      onFirst: (part, made) => this.onCarried((part as { carried: Picture }).carried, made),
    }),
    zones: new Following<Zones>("zones", (zones) => this.onZones(zones), (fault) => this.onNoZones(fault)),
    pose: new Following<Pose>("pose", (pose, made, question) => this.onPose(pose, made, question), (fault) => this.onPoseFault(fault)),
    verify: new Following<Verdict>("verify", (verdict) => this.onVerdict(verdict), (fault) => this.onTaskFault(fault)),
    modes: new Following<Modes>("modes", (modes) => this.onModes(modes), () => undefined),
    sweep: new Following<Sweep>("sweep", (sweep) => this.onSweep(sweep), () => undefined),
  };
  private sweepPoses: number[] = [];

  constructor(readonly start: Start, state: State) {
    this.rules = start.rules;
    this.history = new History(state);
    this.model = this.accepted = new ModelText(state.text);
    setInterval(() => this.sayBusy(), 60);
  }

  /** Whether answers or drawings are still to come, for assistive programs and for tests. */
  private sayBusy(): void {
    const resting = this.hashTimer === undefined && this.quietTimer === undefined;
    const busy = this.frame !== 0 || !resting || Object.values(this.lanes).some((lane) => lane.busy) || this.pending > 0;
    document.documentElement.dataset["busy"] = String(busy);
  }
  private pending = 0;

  get state(): State {
    return this.history.present;
  }
  get theme(): Theme {
    return this.dark ? this.rules.themes.dark : this.rules.themes.light;
  }
  get coordinates(): ModelFacts["coordinates"] {
    return this.facts?.coordinates ?? [];
  }
  /** Whether the mechanism is drawn in the plane of its loci. */
  get inPlace(): boolean {
    return this.facts?.pose_is_place ?? false;
  }
  get units(): Units {
    return this.model.units;
  }
  /** A task as its file says it. */
  taskFile(task: TaskState): string {
    return taskText(task, { names: this.model.coordinateNames, angles: this.coordinates.map((one) => one.angle), unit: this.model.taskUnit });
  }
  /** Whether loci are drawn over the free coordinates; over more of them there are poses and tasks. */
  get traceable(): boolean {
    return this.model.coordinateNames.length <= 3;
  }
  /** Whether the free coordinates are two lengths: what zones are cut from. */
  get overTwoLengths(): boolean {
    return this.coordinates.length === 2 && this.coordinates.every((one) => !one.angle);
  }
  /** The mechanism as it is drawn; points with constructions are where the pose puts them. */
  get drawing(): Drawing {
    const posture = this.pose?.posture;
    if (this.drawn?.text !== this.state.text || this.drawn.posture !== posture) this.drawn = { text: this.state.text, posture, drawing: drawingOf(this.state.text, posture) };
    return this.drawn.drawing;
  }
  private drawn: { text: string; posture: Pose["posture"] | undefined; drawing: Drawing } | undefined;
  /** Whether a coordinate plays: then the pose is shown, not the posture that is drawn. */
  playing = false;
  setPlaying(playing: boolean): void {
    this.playing = playing;
    this.tell("playing");
  }
  /** Whether there is no mechanism at all: the gallery offers some. */
  get nothing(): boolean {
    return this.state.text.trim() === "";
  }
  /** Whether loci are still to be answered. */
  get tracing(): boolean {
    return this.lanes.loci.busy;
  }
  adjustable(id: string): Adjustable | undefined {
    return this.model.adjustables.find((one) => one.id === id);
  }

  watch(watcher: (what: Set<string>) => void): void {
    this.watchers.push(watcher);
  }

  /**
   * Tells everyone, with the next frame. What is told: the name of an answer; "state" and "state.KEY" of what changed in
   * it; "kind" where the mechanism is another one, not only other values of it.
   */
  tell(...what: string[]): void {
    what.forEach((one) => this.news.add(one));
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      const news = this.news;
      this.news = new Set();
      const begun = performance.now();
      this.watchers.forEach((watcher) => watcher(news));
      const moves = this.moves;
      if (moves.length > 0) performance.measure("clearloci-drawing", { start: begun, end: performance.now() });
      this.moves = [];
      // After this frame's drawing has gone to the screen.
      const channel = new MessageChannel();
      channel.port1.onmessage = () => {
        for (const move of moves) performance.measure(`clearloci-${move.name}`, { start: move.made, end: performance.now() });
      };
      channel.port2.postMessage(0);
    });
  }

  /** A change by the hand. `gesture`: changes of one gesture are one step of undo; `field`: beside which an error stands. */
  change(next: Partial<State>, gesture?: string, field?: string): void {
    const before = this.state;
    this.history.set({ ...before, ...next }, gesture);
    this.touched = field;
    this.follow(before);
  }

  undo(): void {
    this.walk(() => this.history.undo());
  }
  /** As if the hand had not begun what it is doing. */
  cancelGesture(): void {
    this.walk(() => this.history.cancelGesture());
  }
  redo(): void {
    this.walk(() => this.history.redo());
  }
  private walk(step: () => void): void {
    const before = this.state;
    step();
    if (!this.nothing) this.history.amend({ ...this.state, drawing: before.drawing }); // what is done is undone, not how it is looked at
    this.touched = undefined;
    this.follow(before);
  }

  /** Another text; on the sheet the pose is that of the posture that is drawn, if it says one. */
  edit(text: string, gesture?: string): void {
    if (text === this.state.text) return;
    const drawing = drawingOf(text, this.pose?.posture);
    const at = (this.state.drawing ? drawnPose(drawing) : undefined) ?? this.state.at;
    const joints = this.state.joints?.filter((name) => drawing.joints.some((one) => one.name === name));
    this.change({ text, at, mode: this.state.mode && drawing.coordinates.length === this.coordinates.length ? this.state.mode : undefined, joints: joints?.length ? joints : undefined }, gesture);
  }

  /** At the drawing, in the posture that is drawn if it says one, or at what follows from it; no step of undo. */
  look(drawing: boolean): void {
    const before = this.state;
    const at = (drawing ? drawnPose(drawingOf(before.text, this.pose?.posture)) : undefined) ?? before.at;
    this.history.amend({ ...before, at, drawing });
    this.touched = undefined;
    this.follow(before);
  }

  /** A mechanism of its own, in the place of the one before. */
  open(file: string, text: string, drawing = false): void {
    this.change({ ...freshState(file, text), zones: this.state.zones, drawing });
  }

  setValue(id: string, value: string, gesture?: string): void {
    const one = this.adjustable(id);
    if (one && value.trim() !== "") this.change({ text: this.model.writeNumber(one.path, value.trim(), this.accepted).text }, gesture, id);
  }

  /** Asks for everything anew. */
  begin(): void {
    this.follow(undefined);
  }

  private question(state = this.state): object {
    const preload = this.effortsOf(state).map(({ joint, value }) => `${joint}=${value}`);
    return { text: state.text, file: state.file, mode: state.mode ?? [], ...(preload.length > 0 ? { preload } : {}) };
  }

  /** Of the free actuators, as they are asked with. */
  get efforts(): (FreeEffort & { value: string })[] {
    return this.effortsOf(this.state);
  }

  private effortsOf(state: State): (FreeEffort & { value: string })[] {
    const model = state.text === this.state.text ? this.model : new ModelText(state.text);
    return model.freeEfforts.map((one) => ({ ...one, value: state.preload[one.joint] ?? usualEffort(one) }));
  }

  /** What loci, zones and verdicts are asked with, and every export of them; `lociQuestionOf` names what is in it. */
  lociQuestion(state = this.state): object {
    const { joints, quantities } = state;
    return { ...this.question(state), ...(joints ? { joints } : {}), ...(quantities?.length ? { quantities } : {}) };
  }

  private follow(before: State | undefined): void {
    const now = this.state;
    const made = performance.now();
    document.documentElement.dataset["busy"] = "true";
    const changed = (...keys: (keyof State)[]): boolean => !before || keys.some((key) => before[key] !== now[key]);
    if (changed("text")) this.model = new ModelText(now.text);
    if (changed("file")) {
      this.accepted = this.model;
      this.forget();
    }
    this.missing = this.nothing ? { words: "" } : now.drawing || !this.facts ? missingIn(drawingOf(now.text)) : undefined;
    if (this.missing) {
      this.forget();
      this.atRest();
      return this.tell("state", "kind", "loci", "pose", "zones", "model", "modes", "verify", ...Object.keys(now).map((key) => `state.${key}`));
    }
    const otherQuestion = changed(...lociQuestionOf);
    if (otherQuestion || (now.drawing && !this.picture && !this.fault)) {
      if (this.traceable) this.lanes.loci.want(this.lociQuestion(), made);
      this.zonesStale = true;
      if (!now.zones) this.zones = undefined;
    }
    // Other values make no other mechanism: what kind it is can wait until the hand rests.
    if (changed("file", "mode") || !this.facts || (now.drawing && changed("text"))) this.lanes.model.want(this.question(), made);
    else if (changed("text")) this.factsStale = true;
    if (changed("text", "mode", "at", "preload") || (changed("task") && this.efforts.length > 0)) this.askPose(made);
    if (otherQuestion || changed("task")) this.askVerdict();
    if (changed("zones") && now.zones) this.askZones();
    if (changed("kept")) void this.askKept();
    if (changed("trajectory", "text", "mode", "preload")) void this.askTrajectory();
    this.atRest();
    this.tell("state", ...(Object.keys(now) as (keyof State)[]).filter((key) => changed(key)).map((key) => `state.${key}`));
  }

  /** Another mechanism: nothing of the one before is shown, nor what is still to be answered of it. */
  private forget(): void {
    for (const lane of Object.values(this.lanes)) lane.forget();
    this.facts = this.picture = this.lastProven = this.zones = this.pose = this.modes = this.verdict = this.sweep = undefined;
    this.fault = this.poseFault = this.taskFault = this.zonesFault = this.progress = undefined;
  }

  private askPose(made: number): void {
    const at = this.state.at;
    if (!at || at.length !== this.model.coordinateNames.length) return;
    // What the task asks of every joint the efforts are to keep.
    const { minForce, minCouple } = this.state.task ?? { minForce: "", minCouple: "" };
    const kept = { ...(isPositive(minForce) ? { min_force: minForce } : {}), ...(isPositive(minCouple) ? { min_couple: minCouple } : {}) };
    this.lanes.pose.want({ ...this.question(), ...kept, at }, made);
  }

  private askVerdict(): void {
    const { task } = this.state;
    if (task && this.facts) this.lanes.verify.want({ ...this.lociQuestion(), task: this.taskFile(task) });
    else this.verdict = undefined;
  }

  private askZones(): void {
    if (this.overTwoLengths) this.lanes.zones.want(this.lociQuestion());
  }

  private async askKept(): Promise<void> {
    const kept = this.state.kept;
    this.kept = undefined;
    if (kept) {
      ++this.pending;
      try {
        const picture = await ask<Picture>("loci", { ...this.lociQuestion({ ...this.state, ...kept }), lane: "kept" });
        if (this.state.kept === kept) this.kept = picture;
      } catch (error) {
        if (!(error instanceof AskingError)) throw error;
      } finally {
        --this.pending;
      }
    }
    this.tell("kept");
  }

  private async askTrajectory(): Promise<void> {
    const { trajectory } = this.state;
    this.trajectoryFault = undefined;
    if (!trajectory) {
      this.trajectory = undefined;
      return this.tell("trajectory");
    }
    ++this.pending;
    try {
      this.trajectory = await ask<Trajectory>("trajectory", { ...this.question(), trajectory });
    } catch (error) {
      if (!(error instanceof AskingError)) throw error;
      if (error.fault.status !== 409) this.trajectoryFault = error.fault.message;
    } finally {
      --this.pending;
    }
    this.tell("trajectory");
  }

  /** Poses along a way, for plots and for the path of a linkage. */
  askSweep(poses: number[]): void {
    this.sweepPoses = poses;
    this.lanes.sweep.want({ ...this.question(), poses, follow: this.facts?.end_effector.at ?? "" });
  }

  /** What can wait until the hand rests: the address, the small pictures of the modes. */
  private atRest(): void {
    clearTimeout(this.hashTimer);
    clearTimeout(this.quietTimer);
    this.hashTimer = setTimeout(() => {
      this.hashTimer = undefined;
      const { state } = this;
      ++this.pending;
      void toHash(state).then((hash) => {
        if (state === this.state) history.replaceState(null, "", hash);
        --this.pending;
      });
    }, 250);
    this.quietTimer = setTimeout(() => {
      this.quietTimer = undefined;
      if (this.missing) return;
      this.lanes.modes.want(this.question());
      if (this.factsStale) this.lanes.model.want(this.question());
      this.factsStale = false;
      this.tell("rest");
    }, 300);
  }

  private onModel(facts: ModelFacts): void {
    const known = this.facts;
    const kindOf = (one: ModelFacts): string => JSON.stringify({ ...one, parameters: undefined, sample: undefined });
    if (!known || kindOf(known) !== kindOf(facts)) this.tell("kind");
    this.facts = facts;
    if (!this.traceable) this.accepted = this.model;
    const at = this.state.at;
    const fits = at && at.length === facts.coordinates.length;
    if (!fits && facts.sample) {
      this.history.amend({ ...this.state, at: facts.sample });
      this.askPose(performance.now());
    }
    if (!known) {
      if (this.state.zones) this.askZones();
      this.askVerdict();
    }
    this.tell("model");
  }

  /** What the eye needs first; everything else waits for the proof. */
  private onCarried(picture: Picture, made: number): void {
    if (this.fault) return; // the last good picture stays until there is another one
    this.picture = picture;
    this.proven = false;
    this.moves.push({ name: "carried", made });
    this.markServer("carried", picture);
    this.tell("loci");
  }

  private onLoci(picture: Picture, made: number): void {
    this.progress = undefined;
    this.fault = undefined;
    if (this.picture && closesNowhere(picture)) return this.onFault({ status: 0, message: picture.loci.notes.at(-1) ?? "", line: 0, column: 0 });
    if (!this.lanes.loci.busy) this.accepted = this.model;
    this.picture = this.lastProven = picture;
    this.proven = true;
    this.moves.push({ name: "loci", made });
    this.markServer("loci", picture);
    if (this.state.zones) this.askZones();
    this.tell("loci");
  }

  private onZones(zones: Zones): void {
    this.zones = zones;
    this.zonesFault = undefined;
    this.zonesStale = this.lanes.loci.busy;
    this.tell("zones");
  }

  private onNoZones(fault: Fault): void {
    this.zones = undefined;
    this.zonesFault = fault.message;
    this.tell("zones");
  }

  private onPose(pose: Pose, made: number, question: object): void {
    this.poseFault = pose.unreachable ? `out of reach: ${pose.unreachable} cannot be placed` : undefined;
    const design = JSON.stringify({ ...question, at: undefined });
    if (!pose.unreachable) [this.pose, this.designOfPose] = [pose, design];
    // The posture of another design is none of this one's. The sheet keeps its points.
    else if (design !== this.designOfPose && !this.state.drawing) this.pose = undefined;
    this.moves.push({ name: "pose", made });
    this.tell("pose");
  }

  private onPoseFault(fault: Fault): void {
    this.poseFault = fault.message;
    this.tell("pose");
  }

  private onVerdict(verdict: Verdict): void {
    this.verdict = this.state.task ? verdict : undefined;
    this.taskFault = undefined;
    this.tell("verify");
  }

  private onTaskFault(fault: Fault): void {
    this.verdict = undefined;
    this.taskFault = fault.message;
    this.tell("verify");
  }

  private onModes(modes: Modes): void {
    this.modes = modes;
    this.tell("modes");
  }

  private onSweep(answer: Sweep): void {
    this.sweep = { coordinate: this.sweepPoses, answer };
    this.tell("sweep");
  }

  /** Loci that were carried over to a design which there is not. */
  private takeBack(): void {
    if (this.proven) return;
    this.picture = this.lastProven;
    this.proven = true;
    this.tell("loci");
  }

  /** The last good picture stays; the words stand beside the field that was changed, or where the file is wrong. */
  private onFault(fault: Fault): void {
    this.progress = undefined;
    this.takeBack();
    this.zonesStale = false; // they are those of the picture that stays
    const placed = fault.line > 0 ? this.model.at(fault.line, fault.column, this.model.adjustables)?.id : undefined;
    this.fault = { message: fault.message, field: this.touched ?? placed, path: fault.line > 0 ? pathAt(this.state.text, fault.line, fault.column) : [] };
    this.tell("fault", "zones");
  }
}

function isPositive(text: string): boolean {
  const exact = parseExact(text);
  return exact !== undefined && toNumber(exact) > 0;
}

/** Such as after a length that cannot close; a note says so. */
function closesNowhere({ loci }: Picture): boolean {
  if ((!loci.complete && (loci.open ?? []).length === 0) || loci.coordinates.length > 2) return false;
  return (loci.reachable ?? []).length === 0 && loci.workspace.every((region) => region.rings.length === 0);
}
