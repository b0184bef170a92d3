import { useMemo, useRef, useState } from 'react';
import { acrossOf, curvePath, downOf, niceStep, ticks, tickText, type Range } from '@/editors/plot/scales';
import { useSize } from '@/editors/plot/useSize';
import { withRoom } from '../diagram/viewport';
import { formatNumber } from '../numbers';
import tuning from './LineChart.module.css';

const LEFT = 66;
const RIGHT = 24;
const BOTTOM = 22;
/** Of the names of the axes and the values at the pointer, which cover no curve. */
const TOP = 18;

interface LineChartProps {
  label: string;
  xs: Float64Array;
  ys: Float64Array;
  color: string;
  xUnit: string;
  yUnit: string;
  /** The places of x go up, so that one is found by the pointer. */
  ordered: boolean;
  /** Shows numbers as what they stand for. */
  xText?: (x: number) => string;
}

/** A curve over any quantity: a spectrum, a difference, one variable over another. */
export function LineChart({ label, xs, ys, color, xUnit, yUnit, ordered, xText }: LineChartProps) {
  const frame = useRef<HTMLDivElement>(null);
  const { width: full, height: tall } = useSize(frame);
  const [at, setAt] = useState<number | null>(null);
  const width = Math.max(1, full - LEFT - RIGHT);
  const height = Math.max(1, tall - TOP - BOTTOM);
  const x = useMemo((): Range => (ordered ? span(xs) : withRoom(rangeOf(xs), 0.04)), [xs, ordered]);
  const y = useMemo(() => withRoom(rangeOf(ys)), [ys]);
  const path = useMemo(() => {
    const drawn = ordered ? peaks(xs, ys, x, Math.ceil(width)) : { xs: [...xs], ys: [...ys] };
    return parts(drawn.xs, drawn.ys)
      .map((part) => curvePath(part.xs, part.ys, x, y, { left: LEFT, width, height }))
      .join('');
  }, [xs, ys, ordered, x, y, width, height]);
  const [acrossTicks, downTicks] = [width / 96, height / 30];
  const near = at === null || !ordered || xs.length === 0 ? null : nearest(xs, at);
  const nameX = xText ?? ((value: number) => tickText(value, niceStep(x, acrossTicks)));
  return (
    <div
      ref={frame}
      className={tuning.chart}
      role="img"
      aria-label={label}
      onPointerMove={(event) => {
        const left = event.clientX - frame.current!.getBoundingClientRect().left - LEFT;
        setAt(x.min + (left / width) * (x.max - x.min));
      }}
      onPointerLeave={() => setAt(null)}
    >
      <svg width={full} height={tall} viewBox={`0 ${-TOP} ${Math.max(1, full)} ${Math.max(1, tall)}`} aria-hidden>
        {ticks(x, acrossTicks).map((value) => {
          const px = LEFT + acrossOf(value, x, width);
          return (
            <g key={value}>
              <line className={tuning.grid} x1={px} x2={px} y1={0} y2={height} />
              <text className={tuning.tick} x={px} y={height + 15} textAnchor="middle">
                {nameX(value)}
              </text>
            </g>
          );
        })}
        {ticks(y, downTicks).map((value) => {
          const py = downOf(value, y, height);
          return (
            <g key={value}>
              <line className={tuning.grid} x1={LEFT} x2={LEFT + width} y1={py} y2={py} />
              <text className={tuning.tick} x={LEFT - 8} y={py} textAnchor="end" dominantBaseline="central">
                {tickText(value, niceStep(y, downTicks))}
              </text>
            </g>
          );
        })}
        <path className={tuning.curve} d={path} style={{ stroke: color }} />
        {near !== null && (
          <line
            className={tuning.cursor}
            x1={LEFT + acrossOf(xs[near]!, x, width)}
            x2={LEFT + acrossOf(xs[near]!, x, width)}
            y1={0}
            y2={height}
          />
        )}
      </svg>
      <span className={tuning.yUnit}>{`↑ ${yUnit}`}</span>
      {xUnit !== '' && <span className={tuning.xUnit}>{`${xUnit} →`}</span>}
      {near !== null && (
        <output className={`${tuning.readout} code`}>
          {`${xText ? xText(xs[near]!) : `${formatNumber(xs[near]!)} ${xUnit}`}: ${formatNumber(ys[near]!)}`}
        </output>
      )}
    </div>
  );
}

const span = (xs: Float64Array): Range =>
  xs.length > 1 ? { min: xs[0]!, max: xs[xs.length - 1]! } : withRoom(rangeOf(xs));

function rangeOf(values: Float64Array): Range | null {
  let [min, max] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < min) min = value;
    if (value > max) max = value;
  }
  return min <= max ? { min, max } : null;
}

/** The least and the greatest value of each pixel column, in their order. */
function peaks(xs: Float64Array, ys: Float64Array, range: Range, columns: number): { xs: number[]; ys: number[] } {
  if (xs.length <= 4 * columns) return { xs: [...xs], ys: [...ys] };
  const found: { xs: number[]; ys: number[] } = { xs: [], ys: [] };
  const push = (k: number) => {
    found.xs.push(xs[k]!);
    found.ys.push(ys[k]!);
  };
  let k = 0;
  for (let column = 1; column <= columns; column += 1) {
    const end = column === columns ? Infinity : range.min + ((range.max - range.min) * column) / columns;
    let [low, high] = [k, k];
    const first = k;
    for (; k < xs.length && xs[k]! < end; k += 1) {
      if (ys[k]! < ys[low]!) low = k;
      if (ys[k]! > ys[high]!) high = k;
    }
    if (k === first) continue;
    push(Math.min(low, high));
    if (low !== high) push(Math.max(low, high));
  }
  return found;
}

/** The parts between gaps. */
function parts(xs: readonly number[], ys: readonly number[]): { xs: number[]; ys: number[] }[] {
  const found: { xs: number[]; ys: number[] }[] = [];
  let open: { xs: number[]; ys: number[] } | null = null;
  ys.forEach((value, k) => {
    if (Number.isNaN(value) || Number.isNaN(xs[k])) {
      open = null;
      return;
    }
    if (open === null) found.push((open = { xs: [], ys: [] }));
    open.xs.push(xs[k]!);
    open.ys.push(value);
  });
  return found;
}

function nearest(xs: Float64Array, at: number): number {
  let best = 0;
  for (let k = 1; k < xs.length; k += 1) if (Math.abs(xs[k]! - at) < Math.abs(xs[best]! - at)) best = k;
  return best;
}
