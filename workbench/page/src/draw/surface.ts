// A canvas with the resolution of the screen, one of several layers above one another.
import type { Size } from "./view";

export class Layer {
  readonly canvas = document.createElement("canvas");
  private readonly own: CanvasRenderingContext2D;

  constructor(parent: HTMLElement, label: string) {
    this.canvas.className = "layer";
    this.canvas.dataset["layer"] = label;
    parent.append(this.canvas);
    const context = this.canvas.getContext("2d");
    if (!context) throw new Error("this browser draws no canvas");
    this.own = context;
  }

  resize(size: Size): void {
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(size.width * ratio);
    this.canvas.height = Math.round(size.height * ratio);
    this.canvas.style.width = `${size.width}px`;
    this.canvas.style.height = `${size.height}px`;
  }

  /** Empty, with a unit of one pixel of the page. */
  begin(): CanvasRenderingContext2D {
    const ratio = window.devicePixelRatio || 1;
    this.own.setTransform(1, 0, 0, 1, 0, 0);
    this.own.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.own.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.own.setLineDash([]);
    this.own.globalAlpha = 1;
    return this.own;
  }
}
