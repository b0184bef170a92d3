import { useMemo, useRef } from 'react';
import { acrossOf, curvePath, downOf, niceStep, ticks, tickText, type Range } from '@/editors/plot/scales';
import { useSize } from '@/editors/plot/useSize';
import styles from './Tuning.module.css';
import { rangeOf, shown, sampleAt } from './tuning';

const LEFT = 64;
const RIGHT = 12;
const AXIS_HEIGHT = 22;
const X_TICK_PX = 90;
const Y_TICK_PX = 32;

export interface Series {
  /** Decides about colour and line. */
  look: 'set' | 'actual' | 'predicted' | 'model' | 'command' | 'torque';
  name: string;
  values: readonly number[];
}

interface ResponsePlotProps {
  title: string;
  unit: string;
  time: readonly number[];
  series: readonly Series[];
  /** The sample that is looked at; null: none. */
  at: number | null;
  onAt: (at: number | null) => void;
  /** The lowest plot carries the time. */
  last: boolean;
}

/** Curves of one quantity over the time, with their legend and the values at the cursor. */
export function ResponsePlot({ title, unit, time, series, at, onAt, last }: ResponsePlotProps) {
  const frame = useRef<HTMLDivElement>(null);
  const { width, height: full } = useSize(frame);
  const height = Math.max(1, full - (last ? AXIS_HEIGHT : 0));
  const plot = Math.max(1, width - LEFT - RIGHT);
  const values = useMemo(() => rangeOf(series.map((one) => one.values)), [series]);
  const window = useMemo((): Range => ({ min: time[0] ?? 0, max: time.at(-1) ?? 1 }), [time]);
  const px = (seconds: number) => LEFT + acrossOf(seconds, window, plot);
  const py = (value: number) => downOf(value, values, height);
  const seconds = ticks(window, plot / X_TICK_PX);
  const levels = ticks(values, height / Y_TICK_PX);
  const paths = useMemo(
    () => series.map((one) => curvePath(time, one.values, window, values, { left: LEFT, width: plot, height })),
    [series, time, window, values, plot, height],
  );
  return (
    <figure className={styles.plot}>
      <figcaption className={styles.legend}>
        <b>{`${title} [${unit}]`}</b>
        {series.map((one) => (
          <span key={one.look} data-look={one.look}>
            <svg width={22} height={8} aria-hidden>
              <line x1={0} x2={22} y1={4} y2={4} />
            </svg>
            {one.name}
            {at !== null && <output className="code">{shown(one.values[at] ?? 0, 5)}</output>}
          </span>
        ))}
        {at !== null && <span className={`${styles.moment} code`}>{`${shown(time[at] ?? 0, 5)} s`}</span>}
      </figcaption>
      <div
        ref={frame}
        className={styles.canvas}
        data-last={last || undefined}
        onPointerMove={(event) => {
          const left = event.clientX - frame.current!.getBoundingClientRect().left - LEFT;
          onAt(sampleAt(time, window.min + (left / plot) * (window.max - window.min)));
        }}
        onPointerLeave={() => onAt(null)}
      >
        <svg width={width} height={full} aria-hidden>
          {seconds.map((x) => (
            <line key={x} className={styles.gridLine} x1={px(x)} x2={px(x)} y1={0} y2={height} />
          ))}
          {levels.map((value) => (
            <g key={value}>
              <line
                className={value === 0 ? styles.zeroLine : styles.gridLine}
                x1={LEFT}
                x2={LEFT + plot}
                y1={py(value)}
                y2={py(value)}
              />
              <text className={styles.tick} x={LEFT - 8} y={py(value)} textAnchor="end" dominantBaseline="central">
                {tickText(value, niceStep(values, height / Y_TICK_PX))}
              </text>
            </g>
          ))}
          {last &&
            seconds.map((x) => (
              <text key={x} className={styles.tick} x={px(x)} y={height + AXIS_HEIGHT / 2 + 2} textAnchor="middle">
                {`${tickText(x, niceStep(window, plot / X_TICK_PX))} s`}
              </text>
            ))}
          {paths.map((path, number) => (
            <path key={series[number]!.look} className={styles.curve} data-look={series[number]!.look} d={path} />
          ))}
          {at !== null && (
            <line className={styles.cursor} x1={px(time[at] ?? 0)} x2={px(time[at] ?? 0)} y1={0} y2={height} />
          )}
        </svg>
      </div>
    </figure>
  );
}
