import { useMemo, useState } from 'react';
import { useText } from '@/i18n';
import { ResponsePlot, type Series } from './ResponsePlot';
import styles from './Tuning.module.css';
import type { Measured, Proposal } from './tuning';

interface ResponseChartProps {
  measured: Measured;
  /** Its prediction is drawn over what was measured. */
  proposal: Proposal | null;
}

/** The recorded answer of an axis over the time: position, velocity, torque where there is one. */
export function ResponseChart({ measured, proposal }: ResponseChartProps) {
  const t = useText();
  const [at, setAt] = useState<number | null>(null);
  const { samples, model } = measured;
  const plots = useMemo(() => {
    if (samples === null) return [];
    const series = (look: Series['look'], name: string, values: readonly number[] | null | undefined): Series[] =>
      values ? [{ look, name, values }] : [];
    return [
      {
        title: t('axis.tuning.position'),
        unit: 'u',
        series: [
          ...series('set', t('axis.tuning.set'), samples.set_position),
          ...series('model', t('axis.tuning.model'), model?.answer),
          ...series('actual', t('axis.tuning.actual'), samples.act_position),
          ...series('predicted', t('axis.tuning.predicted'), proposal?.answer),
        ],
      },
      {
        title: t('axis.tuning.velocity'),
        unit: 'u/s',
        series: [
          ...series('set', t('axis.tuning.set'), samples.command ? null : samples.set_velocity),
          ...series('command', t('axis.tuning.command'), samples.command),
          ...series('actual', t('axis.tuning.actual'), samples.act_velocity),
        ],
      },
      ...(samples.torque
        ? [
            {
              title: t('axis.tuning.torque'),
              unit: 'Nm',
              series: series('torque', t('axis.tuning.actual'), samples.torque),
            },
          ]
        : []),
    ];
  }, [samples, model, proposal, t]);
  if (samples === null) return null;
  const { time } = samples;
  return (
    <div
      className={styles.chart}
      role="group"
      aria-label={t('axis.tuning.chart')}
      tabIndex={0}
      onKeyDown={(event) => {
        const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        const from = at ?? time.findIndex((one) => one >= 0);
        setAt(Math.max(0, Math.min(time.length - 1, from + by * (event.shiftKey ? 10 : 1))));
      }}
      onBlur={() => setAt(null)}
    >
      {plots.map((plot, number) => (
        <ResponsePlot
          key={plot.unit}
          {...plot}
          time={time}
          at={at !== null && at < time.length ? at : null}
          onAt={setAt}
          last={number === plots.length - 1}
        />
      ))}
    </div>
  );
}
