/** The drawing of one diagram: uPlot draws axes and grid, the painter the curves. */
import uPlot from 'uplot';
import { niceStep, tickText, ticks, type Range } from '@/editors/plot/scales';
import { timeLiteral } from '@/iec/duration';
import type { Appearance, TimeAxis, ValueAxis } from '../configuration';
import type { Curve, Curves } from '../data/curves';
import { paintCurve, type CurveLook } from './painter';
import type { Plane } from './plane';
import { momentText, timeGrain, timeStep, timeTicks } from './timeAxis';

export interface Layer {
  curves: Curves;
  curve: Curve;
  look: CurveLook;
  /** In its record. */
  channel: number;
  /** Number of its Y axis. */
  axis: number;
}

/** What is drawn now; changes with every picture, where the axes stay. */
export interface Picture {
  x: Range;
  /** By number of the Y axis. */
  y: ReadonlyMap<number, Range>;
  layers: readonly Layer[];
  /** Moment of the trigger. */
  trigger: number | null;
}

export interface PlotStyle {
  x: TimeAxis;
  /** By number; the first at the left, further ones at the right. */
  y: ReadonlyMap<number, ValueAxis>;
  fontSize: number;
  /** The time stands below this diagram. */
  withTime: boolean;
}

/** Colours of the theme. */
export interface Ink {
  text: string;
  line: string;
  grid: string;
  trigger: string;
  font: string;
}

const LEFT_SIZE = 62;
const SECOND_Y_SIZE = 54;
const X_TICK_PX = 120;
const Y_TICK_PX = 36;
const DASH = [3, 3];

const scaleOf = (axis: number) => `y${axis}`;

export class DiagramPlot {
  readonly plot: uPlot;
  private picture: Picture | null = null;

  constructor(
    place: HTMLElement,
    size: { width: number; height: number },
    private readonly style: PlotStyle,
    private readonly ink: Ink,
  ) {
    const scales: Record<string, uPlot.Scale> = {
      x: { time: false, auto: false, dir: style.x.reverse ? -1 : 1 },
    };
    const axes: uPlot.Axis[] = [this.timeAxis()];
    for (const [number, axis] of style.y) {
      scales[scaleOf(number)] = { auto: false, dir: axis.reverse ? -1 : 1 };
      axes.push(this.valueAxis(number, axis));
    }
    const first = [...style.y.keys()][0] ?? 0;
    this.plot = new uPlot(
      {
        ...size,
        padding: [10, style.y.size > 1 ? 4 : 28, style.withTime ? 0 : 6, 0],
        legend: { show: false },
        cursor: { show: false },
        scales,
        axes,
        series: [{}, { scale: scaleOf(first), paths: () => null, points: { show: false } }],
        hooks: { draw: [() => this.paint()] },
      },
      [
        [0, 1],
        [null, null],
      ],
      place,
    );
  }

  draw(picture: Picture): void {
    this.picture = picture;
    this.plot.batch(() => {
      this.plot.setScale('x', picture.x);
      for (const [number, range] of picture.y) this.plot.setScale(scaleOf(number), range);
    });
    this.plot.redraw(false, true);
  }

  resize(size: { width: number; height: number }): void {
    this.plot.setSize(size);
  }

  destroy(): void {
    this.plot.destroy();
  }

  /** The part that the curves have, in CSS pixels of the place. */
  get area(): { left: number; top: number; width: number; height: number } {
    const { left, top, width, height } = this.plot.bbox;
    const ratio = uPlot.pxRatio;
    return { left: left / ratio, top: top / ratio, width: width / ratio, height: height / ratio };
  }

  /** CSS pixels of a moment, from the left of the place. */
  acrossOf(ns: number): number {
    return this.area.left + this.plot.valToPos(ns, 'x');
  }

  momentAt(across: number): number {
    return this.plot.posToVal(across - this.area.left, 'x');
  }

  valueAt(down: number, axis: number): number {
    return this.plot.posToVal(down - this.area.top, scaleOf(axis));
  }

  private font(): string {
    return `${this.style.fontSize}px ${this.ink.font}`;
  }

  private common(axis: TimeAxis | ValueAxis): uPlot.Axis {
    return {
      font: this.font(),
      stroke: this.ink.text,
      grid: { show: axis.grid, stroke: axis.grid_color || this.ink.grid, width: 1, dash: DASH },
      ticks: { stroke: this.ink.line, width: 1, size: 6 },
      border: { show: true, stroke: this.ink.line, width: 1 },
    };
  }

  private timeAxis(): uPlot.Axis {
    const { x, withTime } = this.style;
    const low = x.position !== 'high';
    const outside = withTime && x.position !== 'middle';
    return {
      ...this.common(x),
      scale: 'x',
      side: low ? 2 : 0,
      size: outside ? this.style.fontSize + 18 : 0,
      splits: (plot, _axis, min, max) => this.timeTicks(plot, { min, max }).ticks,
      values: (plot, splits) => {
        if (!outside) return splits.map(() => null);
        const grain = timeGrain(plot.scales.x!.max! - plot.scales.x!.min!);
        return splits.map((ns) => momentText(ns, grain));
      },
      ...(x.position === 'middle' && { border: { show: false }, ticks: { show: false } }),
    };
  }

  private timeTicks(plot: uPlot, range: Range): { ticks: number[]; step: number } {
    const wanted = timeLiteral(this.style.x.major) ?? 0;
    const width = plot.bbox.width / uPlot.pxRatio;
    const most = Math.max(2, width / Math.max(X_TICK_PX, 9 * this.style.fontSize));
    // A distance that would make a black bar gives way to one that can be read.
    const step = wanted > 0 && (range.max - range.min) / wanted <= width / 12 ? wanted : timeStep(range, most);
    return { ticks: timeTicks(range, step), step };
  }

  private valueAxis(number: number, axis: ValueAxis): uPlot.Axis {
    const first = number === [...this.style.y.keys()][0];
    const right = first ? axis.position === 'high' : true;
    const outside = axis.position !== 'middle' || !first;
    const grid = this.common(axis).grid!;
    return {
      ...this.common(axis),
      scale: scaleOf(number),
      side: right ? 1 : 3,
      size: outside ? (first ? LEFT_SIZE : SECOND_Y_SIZE) : 0,
      grid: first ? grid : { show: false },
      splits: (plot, _axis, min, max) => this.valueTicks(plot, axis, { min, max }).ticks,
      values: (plot, splits) => {
        if (!outside) return splits.map(() => null);
        const { min, max } = plot.scales[scaleOf(number)]!;
        const { step } = this.valueTicks(plot, axis, { min: min!, max: max! });
        return splits.map((value) => tickText(value, step));
      },
      ...(!outside && { border: { show: false }, ticks: { show: false } }),
    };
  }

  private valueTicks(plot: uPlot, axis: ValueAxis, range: Range): { ticks: number[]; step: number } {
    const height = plot.bbox.height / uPlot.pxRatio;
    const fits = axis.major > 0 && (range.max - range.min) / axis.major <= height / 12;
    if (!fits) return { ticks: ticks(range, height / Y_TICK_PX), step: niceStep(range, height / Y_TICK_PX) };
    const first = Math.ceil(range.min / axis.major - 1e-9);
    const count = Math.floor(range.max / axis.major + 1e-9) - first + 1;
    return {
      ticks: Array.from({ length: Math.max(0, count) }, (_, k) => (first + k) * axis.major),
      step: axis.major,
    };
  }

  private plane(axis: number): Plane {
    const { left, top, width, height } = this.plot.bbox;
    const [x, y] = [this.plot.scales.x!, this.plot.scales[scaleOf(axis)]!];
    const across = width / (x.max! - x.min!);
    const down = height / (y.max! - y.min!);
    return {
      left,
      top,
      width,
      height,
      toX: this.style.x.reverse ? (ns) => left + width - (ns - x.min!) * across : (ns) => left + (ns - x.min!) * across,
      toY: this.style.y.get(axis)?.reverse
        ? (value) => top + (value - y.min!) * down
        : (value) => top + height - (value - y.min!) * down,
    };
  }

  private paint(): void {
    const { picture } = this;
    if (picture === null) return;
    const context = this.plot.ctx;
    const ratio = uPlot.pxRatio;
    const planes = new Map([...this.style.y.keys()].map((axis) => [axis, this.plane(axis)]));
    const [plane] = planes.values();
    if (plane === undefined) return;
    if (picture.trigger !== null) {
      const x = Math.round(plane.toX(picture.trigger)) + 0.5;
      if (x >= plane.left && x <= plane.left + plane.width) {
        context.save();
        context.strokeStyle = this.ink.trigger;
        context.lineWidth = ratio;
        context.setLineDash([6 * ratio, 4 * ratio]);
        line(context, x, plane.top, x, plane.top + plane.height);
        context.restore();
      }
    }
    for (const { curves, curve, look, axis } of picture.layers) {
      const own = planes.get(axis) ?? plane;
      paintCurve(context, curves, curve, { ...look, width: look.width * ratio }, own);
    }
    this.paintAxes(context, plane, ratio);
  }

  /** Short ticks, arrows, and axes that stand in the middle. */
  private paintAxes(context: CanvasRenderingContext2D, plane: Plane, ratio: number): void {
    const { x } = this.style;
    const [[number, y]] = [...this.style.y] as [[number, ValueAxis]];
    const right = plane.left + plane.width;
    const bottom = plane.top + plane.height;
    const half = (low: number, high: number) => Math.round((low + high) / 2) + 0.5;
    const xAt = { low: bottom, middle: half(plane.top, bottom), high: plane.top }[x.position];
    const yAt = { low: plane.left, middle: half(plane.left, right), high: right }[y.position];
    context.save();
    context.strokeStyle = this.ink.line;
    context.fillStyle = this.ink.text;
    context.lineWidth = ratio;
    context.font = `${this.style.fontSize * ratio}px ${this.ink.font}`;
    const range = { min: this.plot.scales.x!.min!, max: this.plot.scales.x!.max! };
    const values = { min: this.plot.scales[scaleOf(number)]!.min!, max: this.plot.scales[scaleOf(number)]!.max! };
    const outward = { low: 1, middle: 1, high: -1 };
    if (x.position === 'middle') {
      line(context, plane.left, xAt, right, xAt);
      const grain = timeGrain(range.max - range.min);
      context.textAlign = 'center';
      context.textBaseline = 'top';
      for (const ns of this.timeTicks(this.plot, range).ticks) {
        line(context, plane.toX(ns), xAt, plane.toX(ns), xAt + 6 * ratio);
        context.fillText(momentText(ns, grain), plane.toX(ns), xAt + 8 * ratio);
      }
    }
    if (y.position === 'middle') {
      line(context, yAt, plane.top, yAt, bottom);
      const { ticks: shown, step } = this.valueTicks(this.plot, y, values);
      context.textAlign = 'right';
      context.textBaseline = 'middle';
      for (const value of shown) {
        line(context, yAt - 6 * ratio, plane.toY(value), yAt, plane.toY(value));
        context.fillText(tickText(value, step), yAt - 8 * ratio, plane.toY(value));
      }
    }
    const minorX = timeLiteral(x.minor) ?? 0;
    if (minorX > 0 && (range.max - range.min) / minorX <= plane.width / (4 * ratio))
      for (const ns of timeTicks(range, minorX))
        line(context, plane.toX(ns), xAt, plane.toX(ns), xAt + 3 * ratio * outward[x.position]);
    if (y.minor > 0 && (values.max - values.min) / y.minor <= plane.height / (4 * ratio))
      for (const value of timeTicks(values, y.minor))
        line(context, yAt - 3 * ratio * outward[y.position], plane.toY(value), yAt, plane.toY(value));
    const ahead = x.reverse ? -1 : 1;
    arrow(context, x.arrow, ahead > 0 ? right : plane.left, xAt, 8 * ratio * ahead, 0);
    const upward = y.reverse ? 1 : -1;
    arrow(context, y.arrow, yAt, upward < 0 ? plane.top : bottom, 0, 8 * ratio * upward);
    context.restore();
  }
}

function line(context: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}

/** The end of an axis (TRC-58): the tip at (x, y), back by (dx, dy). */
function arrow(
  context: CanvasRenderingContext2D,
  kind: Appearance['x']['arrow'],
  x: number,
  y: number,
  dx: number,
  dy: number,
): void {
  if (kind === 'none') return;
  context.beginPath();
  context.moveTo(x - dx + dy / 2, y - dy + dx / 2);
  context.lineTo(x, y);
  context.lineTo(x - dx - dy / 2, y - dy - dx / 2);
  if (kind === 'filled') {
    context.closePath();
    context.fill();
  } else context.stroke();
}
