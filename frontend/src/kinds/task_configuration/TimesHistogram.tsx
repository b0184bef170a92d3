import { useMemo, useRef, useState } from 'react';
import type { TaskTimes } from '@/api/types';
import { useText } from '@/i18n';
import { useSize } from '@/editors/plot/useSize';
import { countText, microsText } from '@/workbench/online/times';
import { bars, edges, type Bar } from './monitoring';
import styles from './Monitoring.module.css';

const LEFT = 44;
const AXIS_HEIGHT = 20;
const LABEL_PX = 58;
/** A class that holds one cycle of a million is still seen. */
const LEAST_PX = 2;

interface TimesHistogramProps {
  title: string;
  times: TaskTimes | undefined;
  what: 'cycles' | 'starts';
}

/** How often a time has occurred, in classes that grow by a quarter of an octave. */
export function TimesHistogram({ title, times, what }: TimesHistogramProps) {
  const t = useText();
  const frame = useRef<HTMLDivElement>(null);
  const [pointed, setPointed] = useState<number | null>(null);
  const { width, height: full } = useSize(frame);
  const height = Math.max(1, full - AXIS_HEIGHT);
  const plot = Math.max(1, width - LEFT - 10);
  const shown = useMemo(() => (times === undefined ? [] : bars(times, what)), [times, what]);
  const top = Math.max(0.01, ...shown.map((bar) => bar.share));
  const each = plot / Math.max(1, shown.length);
  const every = Math.max(1, Math.ceil(LABEL_PX / each));
  const at = pointed === null ? undefined : shown[pointed];
  return (
    <figure className={styles.chart} aria-label={title}>
      <figcaption className={styles.caption}>
        <b>{title}</b>
        <output className={`${styles.pointed} code`}>{at && barText(at, t)}</output>
      </figcaption>
      <div
        ref={frame}
        className={styles.plot}
        onPointerMove={(event) => {
          const left = event.clientX - frame.current!.getBoundingClientRect().left - LEFT;
          const number = Math.floor(left / each);
          setPointed(number >= 0 && number < shown.length ? number : null);
        }}
        onPointerLeave={() => setPointed(null)}
      >
        <svg width={width} height={full} aria-hidden>
          {[0, 0.5, 1].map((part) => (
            <g key={part}>
              <line
                className={styles.grid}
                x1={LEFT}
                x2={LEFT + plot}
                y1={4 + (1 - part) * (height - 8)}
                y2={4 + (1 - part) * (height - 8)}
              />
              <text
                className={styles.tick}
                x={LEFT - 6}
                y={4 + (1 - part) * (height - 8)}
                textAnchor="end"
                dominantBaseline="central"
              >
                {`${(top * part * 100).toFixed(top < 0.1 ? 1 : 0)} %`}
              </text>
            </g>
          ))}
          {shown.map((bar, number) => {
            const tall = bar.count === 0 ? 0 : Math.max(LEAST_PX, (bar.share / top) * (height - 8));
            return (
              <rect
                key={bar.fromUs}
                className={styles.bar}
                data-pointed={number === pointed || undefined}
                x={LEFT + number * each + 0.5}
                y={height - 4 - tall}
                width={Math.max(1, each - 1)}
                height={tall}
              />
            );
          })}
          {edges(shown, every).map(({ at: number, us }) => (
            <text
              key={number}
              className={styles.tick}
              x={LEFT + number * each}
              y={height + AXIS_HEIGHT / 2 + 2}
              textAnchor="start"
            >
              {microsText(us)}
            </text>
          ))}
        </svg>
        {shown.length === 0 && <p className={styles.none}>{t('taskConfiguration.noCycles')}</p>}
      </div>
    </figure>
  );
}

function barText(bar: Bar, t: ReturnType<typeof useText>): string {
  const range =
    bar.toUs === Infinity ? `≥ ${microsText(bar.fromUs)}` : `${microsText(bar.fromUs)} – ${microsText(bar.toUs)}`;
  return t('taskConfiguration.classText', {
    range,
    count: bar.count,
    shownCount: countText(bar.count),
    percent: (bar.share * 100).toPrecision(3),
    reached: (Math.floor(bar.reached * 100_000) / 1000).toFixed(3),
  });
}
