// Surfaces of three coordinates, turned by the hand, with a plane to slice them.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, CapsuleGeometry, Color, DirectionalLight, DoubleSide, EdgesGeometry, Group, HemisphereLight, LineBasicMaterial,
  LineSegments, type Material, Mesh as ThreeMesh, MeshBasicMaterial, MeshStandardMaterial, type Object3D, OrthographicCamera, Plane, PlaneGeometry, Raycaster, Scene,
  SphereGeometry, Sprite, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Picture, SurfaceGroup, Theme } from "../data/answers";
import { colourOf, groupKey } from "../draw/loci";
import { axesOf, type Axis } from "./axes";
import { cut, trianglesOf, type Triangles } from "./meshes";

export interface Slice {
  axis: number;
  at: number;
  on: boolean;
}

interface Drawn {
  group: SurfaceGroup;
  mesh: Triangles;
  object: ThreeMesh<BufferGeometry, MeshStandardMaterial>;
}

export class Space {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly controls: OrbitControls;
  private readonly model = new Group();
  onDrawn: () => void = () => undefined;
  private drawn: Drawn[] = [];
  private picture: Picture | undefined;
  private theme: Theme | undefined;
  private marker: ThreeMesh | undefined;
  private task: LineSegments | undefined;
  private frame = 0;
  private mechanism: string | undefined;
  private fitted = false;

  constructor(parent: HTMLElement) {
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.renderer.setPixelRatio(window.devicePixelRatio || 1);
    this.canvas = this.renderer.domElement;
    this.canvas.className = "layer";
    this.canvas.dataset["layer"] = "space";
    parent.append(this.canvas);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(2.6, -3.4, 2.2);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.scene.add(this.model, new HemisphereLight(0xffffff, 0x8890a0, 2.2));
    const sun = new DirectionalLight(0xffffff, 1.6);
    sun.position.set(2, -3, 4);
    this.scene.add(sun);
  }

  resize(width: number, height: number): void {
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    const half = 1.32; // of the box and the numbers beside it
    const wide = Math.max(1, width / height);
    const high = Math.max(1, height / width);
    [this.camera.left, this.camera.right, this.camera.top, this.camera.bottom] = [-half * wide, half * wide, half * high, -half * high];
    this.camera.near = 0.01;
    this.camera.far = 20;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  turn(azimuth: number, elevation: number): void {
    const away = this.camera.position.length();
    const level = Math.hypot(this.camera.position.x, this.camera.position.y);
    const now = [Math.atan2(this.camera.position.y, this.camera.position.x) + azimuth, Math.atan2(this.camera.position.z, level) + elevation];
    const up = Math.min(1.5, Math.max(-1.5, now[1] ?? 0));
    this.camera.position.set(away * Math.cos(up) * Math.cos(now[0] ?? 0), away * Math.cos(up) * Math.sin(now[0] ?? 0), away * Math.sin(up));
    this.controls.update();
    this.draw();
  }

  zoom(factor: number): void {
    this.camera.zoom *= factor;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** From a coordinate's range to about -0.8 to 0.8; lengths keep their proportions. */
  private get scales(): { middle: number[]; factor: number[] } {
    const box = this.picture?.loci.box ?? [];
    const angle = (k: number): boolean => this.picture?.loci.units?.[k] === "rad";
    const lengths = box.filter((_, k) => !angle(k)).map(([low, high]) => high - low);
    const largest = Math.max(...lengths, 1e-12);
    return {
      middle: box.map(([low, high]) => (low + high) / 2),
      factor: box.map(([low, high], k) => 1.5 / (angle(k) ? high - low : largest)),
    };
  }

  place(at: readonly number[]): Vector3 {
    const { middle, factor } = this.scales;
    const along = (k: number): number => ((at[k] ?? 0) - (middle[k] ?? 0)) * (factor[k] ?? 1);
    return new Vector3(along(0), along(1), along(2));
  }

  /** `proven`: not yet where it is false; surfaces are nets then. */
  show(picture: Picture, theme: Theme, hidden: ReadonlySet<string>, slice: Slice | undefined, axes: readonly Axis[] = [], proven = true): void {
    if (picture.meshes !== this.picture?.meshes || picture.surface_groups !== this.picture.surface_groups) {
      this.picture = picture;
      this.drawn.forEach((one) => one.object.geometry.dispose());
      const meshes = new Map(picture.meshes.map((mesh) => [mesh.id, trianglesOf(mesh)]));
      this.drawn = picture.surface_groups.flatMap((group) =>
        group.ids.flatMap((id) => {
          const mesh = meshes.get(id);
          return mesh && mesh.triangles.length > 0 ? [{ group, mesh, object: this.objectOf(mesh) }] : [];
        }),
      );
    }
    if (picture.loci.mechanism !== this.mechanism) {
      this.mechanism = picture.loci.mechanism;
      this.fitted = false;
      this.zoom(1 / this.camera.zoom);
    }
    this.theme = theme;
    this.clear();
    this.model.add(this.boxEdges(theme));
    const { middle, factor } = this.scales;
    this.model.add(axesOf(axes, ...this.corners, (axis, at) => (at - (middle[axis] ?? 0)) * (factor[axis] ?? 1), theme));
    // What lies below the plane stays; above it is cut away, so that the section is seen.
    const planes = slice?.on ? [this.clipping(slice)] : [];
    for (const { group, object, mesh } of this.drawn) {
      if (hidden.has(groupKey(group))) continue;
      const material = object.material;
      material.color = new Color(colourOf(theme, group.colour));
      material.opacity = group.opacity;
      material.wireframe = !proven;
      material.transparent = group.opacity < 1;
      material.depthWrite = group.opacity > 0.5;
      material.clippingPlanes = planes;
      object.renderOrder = group.opacity > 0.5 ? 0 : 1;
      this.model.add(object);
      if (slice?.on) this.model.add(this.section(mesh, slice, colourOf(theme, group.colour)));
    }
    for (const group of picture.surface_groups) if (!hidden.has(groupKey(group))) this.showThin(picture, group, colourOf(theme, group.colour), planes);
    if (slice?.on) this.model.add(this.sheet(slice, theme));
    if (this.marker) this.model.add(this.marker);
    if (this.task) this.model.add(this.task);
    this.draw();
  }

  /** Curves and points that are part of no surface: seen through those before them. */
  private showThin(picture: Picture, group: SurfaceGroup, colour: string, planes: Plane[]): void {
    const own = new Set(group.ids);
    const ends = picture.loci.curves.filter((curve) => own.has(curve.id)).flatMap((curve) => curve.arcs).flatMap(({ points }) => {
      const places = points.map((at) => this.place(at));
      return places.slice(1).flatMap((end, k) => [...(places[k] ?? end).toArray(), ...end.toArray()]);
    });
    if (ends.length > 0) {
      const lines = new LineSegments2(new LineSegmentsGeometry().setPositions(ends), new LineMaterial({ color: new Color(colour).getHex(), linewidth: 4, depthTest: false, transparent: true, clippingPlanes: planes }));
      lines.renderOrder = 2;
      this.model.add(lines);
    }
    for (const index of group.points) {
      const at = picture.loci.isolated_points[index]?.at;
      if (!at) continue;
      const ball = new ThreeMesh(new SphereGeometry(0.018), new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true, clippingPlanes: planes }));
      ball.renderOrder = 2;
      ball.position.copy(this.place(at));
      this.model.add(ball);
    }
  }

  /** The task as a box of one range a coordinate. */
  showTask(low: readonly number[] | undefined, high: readonly number[] | undefined, colour: string): void {
    if (this.task) {
      this.model.remove(this.task);
      release(this.task);
    }
    this.task = undefined;
    if (low && high) {
      const [from, to] = [this.place(low), this.place(high)];
      const size = to.clone().sub(from);
      this.task = new LineSegments(new EdgesGeometry(new BoxGeometry(size.x, size.y, size.z)), new LineBasicMaterial({ color: colour, depthTest: false }));
      this.task.position.copy(from.add(to).multiplyScalar(0.5));
      this.task.renderOrder = 2;
      this.model.add(this.task);
    }
    this.draw();
  }

  showPose(at: readonly number[] | undefined, lines: readonly (readonly number[])[][]): void {
    if (this.marker) {
      this.model.remove(this.marker);
      release(this.marker);
    }
    this.marker = undefined;
    if (at && this.theme) {
      this.marker = new ThreeMesh(new SphereGeometry(0.03), new MeshBasicMaterial({ color: this.theme.ink, depthTest: false }));
      this.marker.renderOrder = 3;
      this.marker.position.copy(this.place(at));
      const points = lines.flatMap((line) => line.slice(1).flatMap((end, k) => [this.place(line[k] ?? end), this.place(end)]));
      this.showWhole(points);
      if (points.length > 0) {
        const here = this.place(at);
        const material = new MeshStandardMaterial({ color: this.theme.link, roughness: 0.5, metalness: 0.1 });
        for (let k = 0; k + 1 < points.length; k += 2) {
          const bar = barBetween((points[k] ?? here).clone().sub(here), (points[k + 1] ?? here).clone().sub(here), material);
          if (bar) this.marker.add(bar);
        }
      }
      this.model.add(this.marker);
    }
    this.draw();
  }

  /** Of a mechanism that comes anew: from so far that it is seen whole. */
  private showWhole(points: readonly Vector3[]): void {
    if (points.length === 0 || this.fitted) return;
    this.fitted = true;
    this.camera.updateMatrixWorld();
    const largest = Math.max(...points.flatMap((point) => { const at = point.clone().project(this.camera); return [Math.abs(at.x), Math.abs(at.y)]; }));
    if (largest > 1) this.zoom(0.96 / largest);
  }

  /** Where the marked pose stands on the canvas, in pixels from its upper left. */
  get poseOnCanvas(): [number, number] | undefined {
    const at = this.marker?.position.clone().project(this.camera);
    return at && [((1 + at.x) * this.canvas.clientWidth) / 2, ((1 - at.y) * this.canvas.clientHeight) / 2];
  }

  /** Where the marked pose comes to when it is dragged there, in the plane across the line of sight. */
  dragged(x: number, y: number): number[] | undefined {
    if (!this.marker) return undefined;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(x, y), this.camera);
    const across = new Plane().setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(new Vector3()), this.marker.position);
    const to = ray.ray.intersectPlane(across, new Vector3());
    const { middle, factor } = this.scales;
    return to?.toArray().map((value, k) => value / (factor[k] ?? 1) + (middle[k] ?? 0));
  }

  /** Empties the scene; what is drawn anew each time gives its memory back. */
  private clear(): void {
    const kept = new Set<unknown>(this.drawn.map((one) => one.object));
    for (const child of this.model.children) if (!kept.has(child) && child !== this.marker && child !== this.task) release(child);
    this.model.clear();
  }

  /** The surface under a place of the canvas, from -1 to 1 in both directions. */
  at(x: number, y: number): string | undefined {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(x, y), this.camera);
    const shown = this.drawn.filter((one) => one.object.parent === this.model);
    for (const hit of ray.intersectObjects(shown.map((one) => one.object))) {
      const own = shown.find((one) => one.object === hit.object);
      const planes = own?.object.material.clippingPlanes ?? [];
      if (planes.every((plane) => plane.distanceToPoint(hit.point) >= 0)) return own?.mesh.id;
    }
    return undefined;
  }

  private objectOf(mesh: Triangles): Drawn["object"] {
    const geometry = new BufferGeometry();
    const { middle, factor } = this.scales;
    const places = mesh.vertices.map((value, k) => (value - (middle[k % 3] ?? 0)) * (factor[k % 3] ?? 1));
    geometry.setAttribute("position", new BufferAttribute(places, 3));
    geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
    geometry.computeVertexNormals();
    return new ThreeMesh(geometry, new MeshStandardMaterial({ side: DoubleSide, roughness: 0.75, metalness: 0 }));
  }

  private get corners(): [Vector3, Vector3] {
    const box = this.picture?.loci.box ?? [];
    return [this.place(box.map((range) => range[0])), this.place(box.map((range) => range[1]))];
  }

  private boxEdges(theme: Theme): LineSegments {
    const [low, high] = this.corners;
    const size = high.clone().sub(low);
    const edges = new LineSegments(new EdgesGeometry(new BoxGeometry(size.x, size.y, size.z)), new LineBasicMaterial({ color: theme.frame }));
    edges.position.copy(low.add(high).multiplyScalar(0.5));
    return edges;
  }

  private clipping(slice: Slice): Plane {
    const { middle, factor } = this.scales;
    const normal = new Vector3().setComponent(slice.axis, -1);
    return new Plane(normal, (slice.at - (middle[slice.axis] ?? 0)) * (factor[slice.axis] ?? 1) + 1e-4);
  }

  private section(mesh: Triangles, slice: Slice, colour: string): LineSegments {
    const flat = cut(mesh, slice.axis, slice.at);
    const points: Vector3[] = [];
    for (let k = 0; k < flat.length; k += 3) points.push(this.place(flat.slice(k, k + 3)));
    const line = new LineSegments(new BufferGeometry().setFromPoints(points), new LineBasicMaterial({ color: colour, depthTest: false }));
    line.renderOrder = 2;
    return line;
  }

  private sheet(slice: Slice, theme: Theme): ThreeMesh {
    const [low, high] = this.corners;
    const size = high.clone().sub(low);
    const [wide, tall] = slice.axis === 0 ? [size.z, size.y] : slice.axis === 1 ? [size.x, size.z] : [size.x, size.y];
    const sheet = new ThreeMesh(new PlaneGeometry(wide, tall), new MeshBasicMaterial({ color: theme.zones[4] ?? theme.workspace, transparent: true, opacity: 0.16, side: DoubleSide, depthWrite: false }));
    if (slice.axis === 0) sheet.rotation.y = Math.PI / 2;
    if (slice.axis === 1) sheet.rotation.x = Math.PI / 2;
    sheet.position.copy(low.add(high).multiplyScalar(0.5));
    const { middle, factor } = this.scales;
    sheet.position.setComponent(slice.axis, (slice.at - (middle[slice.axis] ?? 0)) * (factor[slice.axis] ?? 1));
    return sheet;
  }

  draw(): void {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      this.renderer.render(this.scene, this.camera);
      this.onDrawn();
    });
  }
}

/** A link as a rod with round ends. */
function barBetween(from: Vector3, to: Vector3, material: MeshStandardMaterial): ThreeMesh | undefined {
  const thick = 0.014;
  const along = to.clone().sub(from);
  const length = along.length();
  if (length < 1e-9) return undefined;
  const bar = new ThreeMesh(new CapsuleGeometry(thick, length, 4, 12), material);
  bar.position.copy(from.clone().add(to).multiplyScalar(0.5));
  bar.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), along.multiplyScalar(1 / length));
  return bar;
}

function release(object: Object3D): void {
  object.traverse((one) => {
    if (one instanceof Sprite) {
      one.material.map?.dispose();
      one.material.dispose();
      return;
    }
    if (!(one instanceof ThreeMesh || one instanceof LineSegments)) return;
    (one.geometry as BufferGeometry).dispose();
    const material = one.material as Material | Material[];
    (Array.isArray(material) ? material : [material]).forEach((own) => own.dispose());
  });
}
