// A plot that follows: one of uPlot's, made anew where its series change, else fed with new values.
import uPlot from "uplot";
import type { Theme } from "../data/answers";
import { h } from "./dom";

export interface Series {
  label: string;
  values: (number | null)[];
}

export interface PlotData {
  xLabel: string;
  yLabel: string;
  x: number[];
  series: Series[];
  /** Places along x that are marked: where contact is lost. */
  marks: number[];
}

const dashes = [[], [8, 3], [2, 3], [10, 3, 2, 3], [5, 2], [1, 2]];

export class Plot {
  readonly element = h("figure", { class: "plot" });
  private plot: uPlot | undefined;
  private made = "";
  private marks: number[] = [];
  onCursor: (x: number) => void = () => undefined;

  constructor(private readonly label: string) {
    this.element.setAttribute("aria-label", label);
    new ResizeObserver(() => this.plot?.setSize({ width: this.width, height: 170 })).observe(this.element);
  }

  private get width(): number {
    return Math.max(200, this.element.clientWidth);
  }

  show(data: PlotData, theme: Theme): void {
    this.marks = data.marks;
    const columns: uPlot.AlignedData = [data.x, ...data.series.map((one) => one.values)];
    const made = JSON.stringify([data.xLabel, data.yLabel, data.series.map((one) => one.label), theme.ink]);
    if (this.plot && made === this.made) return this.plot.setData(columns);
    this.made = made;
    this.plot?.destroy();
    const axis = { stroke: theme.ink, grid: { stroke: theme.grid, width: 1 }, ticks: { stroke: theme.grid, width: 1 } };
    this.plot = new uPlot(
      {
        title: this.label,
        width: this.width,
        height: 170,
        scales: { x: { time: false } },
        axes: [{ ...axis, label: data.xLabel, labelSize: 18, size: 30 }, { ...axis, label: data.yLabel, labelSize: 18, size: 46 }],
        legend: { show: true, live: false },
        cursor: { drag: { setScale: false } },
        series: [
          { label: data.xLabel },
          ...data.series.map((one, k) => ({ label: one.label, stroke: theme.curves[k % theme.curves.length] ?? theme.ink, width: 1.6, dash: dashes[k % dashes.length] ?? [], spanGaps: false, points: { show: false } })),
        ],
        hooks: {
          draw: [(plot) => this.drawMarks(plot, theme)],
          setCursor: [(plot) => {
            const left = plot.cursor.left ?? -1;
            if (left >= 0 && this.pressed) this.onCursor(plot.posToVal(left, "x"));
          }],
        },
      },
      columns,
      this.element,
    );
    this.plot.over.addEventListener("pointerdown", (event) => {
      this.pressed = true;
      this.onCursor(this.plot?.posToVal(event.offsetX, "x") ?? 0);
    });
    window.addEventListener("pointerup", () => (this.pressed = false));
  }
  private pressed = false;

  private drawMarks(plot: uPlot, theme: Theme): void {
    const { ctx } = plot;
    ctx.save();
    ctx.strokeStyle = theme.failed;
    ctx.lineWidth = 1.2 * uPlot.pxRatio;
    ctx.setLineDash([4, 4]);
    ctx.beginPath();
    for (const mark of this.marks) {
      const x = plot.valToPos(mark, "x", true);
      ctx.moveTo(x, plot.bbox.top);
      ctx.lineTo(x, plot.bbox.top + plot.bbox.height);
    }
    ctx.stroke();
    ctx.restore();
  }
}
