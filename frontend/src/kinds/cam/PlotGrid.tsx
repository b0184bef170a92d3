import styles from './Cam.module.css';
import { niceStep, tickText, ticks, type Range } from './plot';

interface PlotGridProps {
  /** Pixels of the plot; numbers of the values stand left of it. */
  left: number;
  right: number;
  height: number;
  values: Range;
  py: (value: number) => number;
  /** About so many values are numbered. */
  count: number;
  /** Pixels at the top that belong to a title, so that no number stands there. */
  title: number;
  /** Places of upright lines. */
  upright?: readonly number[];
}

/** The lines behind a curve with the numbers of its values. */
export function PlotGrid({ left, right, height, values, py, count, title, upright }: PlotGridProps) {
  const step = niceStep(values, count);
  return (
    <>
      {upright?.map((x) => (
        <line key={x} className={styles.gridLine} x1={x} x2={x} y1={0} y2={height} />
      ))}
      {ticks(values, count).map((value) => (
        <g key={value}>
          <line
            className={value === 0 ? styles.zeroLine : styles.gridLine}
            x1={left}
            x2={right}
            y1={py(value)}
            y2={py(value)}
          />
          {py(value) > title && py(value) < height - 6 && (
            <text className={styles.tick} x={left - 6} y={py(value)} textAnchor="end" dominantBaseline="central">
              {tickText(value, step)}
            </text>
          )}
        </g>
      ))}
    </>
  );
}
