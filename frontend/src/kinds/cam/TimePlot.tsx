import { useMemo, useRef, useState } from 'react';
import { numberText } from '@/editors/form/numbers';
import styles from './Cam.module.css';
import { TITLE_HEIGHT } from './Graph';
import { PlotGrid } from './PlotGrid';
import {
  acrossOf,
  downOf,
  type GraphName,
  MARGIN_LEFT,
  MARGIN_RIGHT,
  niceStep,
  pathOf,
  type Range,
  ticks,
  tickText,
} from './plot';
import { useSize } from '@/editors/plot/useSize';

const X_TICK_PX = 90;
const Y_TICK_PX = 24;
const AXIS_HEIGHT = 20;

interface TimePlotProps {
  title: string;
  curve: GraphName;
  time: readonly number[];
  values: readonly number[];
  /** Drawn at both signs; null: there is none. */
  limit: number | null;
  /** The lowest one carries the time. */
  last: boolean;
}

/** A value over the time, with its limits. */
export function TimePlot({ title, curve, time, values, limit, last }: TimePlotProps) {
  const frame = useRef<HTMLDivElement>(null);
  const { width, height: full } = useSize(frame);
  const [at, setAt] = useState<number | null>(null);
  const height = Math.max(1, full - (last ? AXIS_HEIGHT : 0));
  const plot = Math.max(1, width - MARGIN_LEFT - MARGIN_RIGHT);
  const shown = useMemo(() => rangeOf(values, limit), [values, limit]);
  const window = useMemo((): Range => ({ min: time[0] ?? 0, max: time.at(-1) ?? 1 }), [time]);
  const px = (seconds: number) => MARGIN_LEFT + acrossOf(seconds, window, plot);
  const py = (value: number) => downOf(value, shown, height);
  const seconds = ticks(window, plot / X_TICK_PX);
  const stepTime = niceStep(window, plot / X_TICK_PX);
  const path = useMemo(
    () => pathOf(time, values, window, shown, plot, height),
    [time, values, window, shown, plot, height],
  );
  const near = at === null ? null : nearest(time, at);
  return (
    <div
      ref={frame}
      className={styles.timePlot}
      data-last={last || undefined}
      role="img"
      aria-label={title}
      onPointerMove={(event) => {
        const left = event.clientX - frame.current!.getBoundingClientRect().left - MARGIN_LEFT;
        setAt(window.min + (left / plot) * (window.max - window.min));
      }}
      onPointerLeave={() => setAt(null)}
    >
      <svg width={width} height={full} aria-hidden>
        <PlotGrid
          left={MARGIN_LEFT}
          right={MARGIN_LEFT + plot}
          height={height}
          values={shown}
          py={py}
          count={height / Y_TICK_PX}
          title={TITLE_HEIGHT}
          upright={seconds.map(px)}
        />
        {last &&
          seconds.map((x) => (
            <text
              key={x}
              className={styles.tick}
              x={px(x)}
              y={height + AXIS_HEIGHT / 2}
              textAnchor="middle"
              dominantBaseline="central"
            >
              {`${tickText(x, stepTime)} s`}
            </text>
          ))}
        {limit !== null &&
          [limit, -limit].map((value) => (
            <line
              key={value}
              className={styles.limit}
              data-limit={value > 0 ? 'upper' : 'lower'}
              x1={MARGIN_LEFT}
              x2={MARGIN_LEFT + plot}
              y1={py(value)}
              y2={py(value)}
            />
          ))}
        <path className={styles.curve} data-curve={curve} d={path} />
        {near !== null && (
          <line className={styles.border} x1={px(time[near]!)} x2={px(time[near]!)} y1={0} y2={height} />
        )}
      </svg>
      <div className={styles.graphHead}>
        <span data-curve={curve}>{title}</span>
        {near !== null && (
          <span className={`${styles.at} code`}>
            {`${numberText(Number(time[near]!.toPrecision(5)))} s: ${numberText(Number(values[near]!.toPrecision(7)))}`}
          </span>
        )}
      </div>
    </div>
  );
}

function rangeOf(values: readonly number[], limit: number | null): Range {
  let [min, max] = [0, 0];
  for (const value of values) [min, max] = [Math.min(min, value), Math.max(max, value)];
  // A limit far away would press the curve flat: it is drawn where it comes into sight.
  const near = limit !== null && limit < 3 * Math.max(-min, max, 1e-12);
  if (near) [min, max] = [Math.min(min, -limit), Math.max(max, limit)];
  if (max - min < 1e-12) return { min: -1, max: 1 };
  const room = 0.08 * (max - min);
  return { min: min - room, max: max + room };
}

function nearest(sorted: readonly number[], value: number): number | null {
  if (sorted.length === 0) return null;
  let best = 0;
  sorted.forEach((one, index) => {
    if (Math.abs(one - value) < Math.abs(sorted[best]! - value)) best = index;
  });
  return best;
}
