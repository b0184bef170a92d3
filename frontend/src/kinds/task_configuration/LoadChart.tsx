import { useMemo, useRef, useState } from 'react';
import type { LoadOfTasks } from '@/api/types';
import { useText } from '@/i18n';
import { acrossOf, curvePath, downOf, type Range } from '@/editors/plot/scales';
import { useSize } from '@/editors/plot/useSize';
import { Select } from '@/ui/Field';
import { loadSeries } from './monitoring';
import styles from './Monitoring.module.css';

const LEFT = 44;
const AXIS_HEIGHT = 20;
const WINDOWS = ['60', '300', '600'] as const;
const PERCENT: Range = { min: 0, max: 100 };
const LEVELS = [0, 25, 50, 75, 100];

/** How busy the tasks and the processors of the host are, over the last minutes. */
export function LoadChart({ load }: { load: LoadOfTasks | undefined }) {
  const t = useText();
  const [seconds, setSeconds] = useState<(typeof WINDOWS)[number]>('60');
  const frame = useRef<HTMLDivElement>(null);
  const { width, height: full } = useSize(frame);
  const height = Math.max(1, full - AXIS_HEIGHT);
  const plot = Math.max(1, width - LEFT - 10);
  const span = Number(seconds);
  const window = useMemo((): Range => ({ min: -span, max: 0 }), [span]);
  const { ago, series } = useMemo(
    () =>
      load === undefined
        ? { ago: [], series: [] }
        : loadSeries(load, span, (number) => t('taskConfiguration.processor', { number })),
    [load, span, t],
  );
  const marks = [1, 0.75, 0.5, 0.25, 0].map((part) => -span * part);
  return (
    <figure className={styles.chart} aria-label={t('taskConfiguration.load')}>
      <figcaption className={styles.caption}>
        <b>{t('taskConfiguration.load')}</b>
        <span className={styles.tools}>
          <Select<(typeof WINDOWS)[number]>
            aria-label={t('taskConfiguration.window')}
            value={seconds}
            choices={WINDOWS.map((value) => ({
              value,
              text: t('taskConfiguration.minutes', { count: Number(value) / 60 }),
            }))}
            onValue={setSeconds}
          />
        </span>
      </figcaption>
      <ul className={styles.legend}>
        {series.map((one, at) => (
          <li key={one.name} data-of={one.of} data-color={at % 8}>
            <svg width={18} height={8} aria-hidden>
              <line x1={0} x2={18} y1={4} y2={4} />
            </svg>
            {one.name}
            <output className="code">{percent(one.values.at(-1))}</output>
          </li>
        ))}
      </ul>
      <div ref={frame} className={styles.plot}>
        <svg width={width} height={full} aria-hidden>
          {LEVELS.map((level) => (
            <g key={level}>
              <line
                className={styles.grid}
                x1={LEFT}
                x2={LEFT + plot}
                y1={downOf(level, PERCENT, height - 8) + 4}
                y2={downOf(level, PERCENT, height - 8) + 4}
              />
              <text
                className={styles.tick}
                x={LEFT - 6}
                y={downOf(level, PERCENT, height - 8) + 4}
                textAnchor="end"
                dominantBaseline="central"
              >
                {`${String(level)} %`}
              </text>
            </g>
          ))}
          {marks.map((mark) => (
            <text
              key={mark}
              className={styles.tick}
              x={LEFT + acrossOf(mark, window, plot)}
              y={height + AXIS_HEIGHT / 2 + 2}
              textAnchor={mark === 0 ? 'end' : mark === -span ? 'start' : 'middle'}
            >
              {`${String(mark)} s`}
            </text>
          ))}
          <g transform="translate(0 4)">
            {series.map((one, at) => (
              <path
                key={one.name}
                className={styles.curve}
                data-of={one.of}
                data-color={at % 8}
                d={curvePath(ago, one.values, window, PERCENT, { left: LEFT, width: plot, height: height - 8 })}
              />
            ))}
          </g>
        </svg>
        {ago.length === 0 && <p className={styles.none}>{t('taskConfiguration.noLoad')}</p>}
      </div>
    </figure>
  );
}

function percent(value: number | undefined): string {
  return value === undefined ? '–' : `${value.toFixed(value < 9.95 ? 1 : 0)} %`;
}
