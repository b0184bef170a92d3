import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { Range } from '@/editors/plot/scales';
import { durationText, signedDuration } from '@/iec/duration';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Select, TextInput } from '@/ui/Field';
import { notify } from '@/ui/notices';
import { bestShift, difference } from '../analysis/compare';
import { statistics } from '../analysis/statistics';
import type { TraceData } from '../configuration';
import type { RunData } from '../data/runData';
import { sourcePath } from '../data/source';
import type { OverlayRun } from '../Diagrams';
import { automaticColor } from '../diagram/ink';
import { momentText, timeGrain } from '../diagram/timeAxis';
import { formatNumber } from '../numbers';
import type { TraceView } from '../traceView';
import styles from '../Trace.module.css';
import panel from './Panels.module.css';
import { channelsOf, samplesOf } from './channels';
import { LineChart } from './LineChart';

const MOST_SAMPLES = 16_384;

interface ComparePanelProps {
  data: TraceData;
  run: RunData;
  range: Range;
  overlays: readonly OverlayRun[];
  view: TraceView;
  onView: (change: (view: TraceView) => TraceView) => void;
}

/** What is shown less a recording that is drawn over it, which can be moved in time. */
export function ComparePanel({ data, run, range, overlays, view, onView }: ComparePanelProps) {
  const t = useText();
  const channels = channelsOf(data);
  const [chosen, setChosen] = useState<{ channel: string | null; other: number }>({ channel: null, other: 0 });
  const [typed, setTyped] = useState<string | null>(null);
  const ref = channels.find(({ key }) => key === chosen.channel) ?? channels[0];
  const number = Math.min(chosen.other, overlays.length - 1);
  const overlay = overlays[number];
  const shift = overlay?.shift ?? 0;
  const { data: runs } = useQuery({
    queryKey: [
      'trace-compare',
      sourcePath(run.source),
      overlay ? sourcePath(overlay.run.source) : null,
      String(overlay?.run.origin),
      ref?.key,
      range,
      shift,
    ],
    queryFn: async ({ signal }) => {
      const moved = { min: range.min - shift, max: range.max - shift };
      const [one, other] = await Promise.all([
        samplesOf(run, data, ref!, range, MOST_SAMPLES, signal),
        samplesOf(overlay!.run, data, ref!, moved, MOST_SAMPLES, signal),
      ]);
      if (!one || !other) return null;
      return { one: { time: one.window.time, values: one.low }, other: { time: other.window.time, values: other.low } };
    },
    enabled: ref !== undefined && overlay !== undefined && run.origin !== null && overlay.run.origin !== null,
    placeholderData: (before) => before,
    gcTime: 0,
    retry: false,
  });
  if (overlay === undefined || ref === undefined) return <p className={styles.note}>{t('trace.noOverlay')}</p>;
  const setShift = (ns: number) => {
    setTyped(null);
    const { id } = view.overlays[number]!;
    onView((before) => ({
      ...before,
      overlays: before.overlays.map((one) => (one.id === id ? { ...one, shift: ns } : one)),
    }));
  };
  const align = () => {
    const found = runs ? bestShift(runs.one, runs.other) : null;
    if (found === null) notify({ tone: 'info', title: t('trace.noAlign') });
    else setShift(Math.round(found));
  };
  const apart = runs ? difference(runs.one, runs.other, shift) : null;
  const about = apart ? statistics(apart) : null;
  const fault = typed !== null && signedDuration(typed) === null;
  const grain = timeGrain(range.max - range.min);
  return (
    <div className={panel.chartBody}>
      <div className={panel.choices}>
        <label>
          {t('trace.variable')}
          <Select
            label={t('trace.variable')}
            value={ref.key}
            choices={channels.map(({ key, name }) => ({ value: key, text: name }))}
            onValue={(channel) => setChosen((before) => ({ ...before, channel }))}
          />
        </label>
        <label>
          {t('trace.lessRun')}
          <Select
            label={t('trace.lessRun')}
            value={String(number)}
            choices={overlays.map(({ title }, at) => ({ value: String(at), text: title }))}
            onValue={(at) => setChosen((before) => ({ ...before, other: Number(at) }))}
          />
        </label>
        <label>
          {t('trace.shift')}
          <TextInput
            className="code"
            aria-label={t('trace.shift')}
            aria-invalid={fault || undefined}
            title={fault ? t('trace.fault.time') : undefined}
            value={typed ?? durationText(shift)}
            onValue={setTyped}
            onBlur={() => typed !== null && setShift(signedDuration(typed) ?? shift)}
            onKeyDown={(event) => {
              if (event.key === 'Enter' && typed !== null) setShift(signedDuration(typed) ?? shift);
            }}
          />
        </label>
        <Button onClick={align}>{t('trace.align')}</Button>
        {about && (
          <span className="code">
            {t('trace.differs', {
              most: formatNumber(Math.max(-about.min, about.max)),
              rms: formatNumber(about.rms),
            })}
          </span>
        )}
      </div>
      {runs && apart && (
        <div className={panel.chartPlace} style={{ display: 'flex' }}>
          <LineChart
            label={t('trace.difference')}
            xs={Float64Array.from(runs.one.time)}
            ys={apart}
            color={ref.channel.color || automaticColor(ref.number)}
            xUnit=""
            yUnit={t('trace.difference')}
            ordered
            xText={(ns) => momentText(ns, grain)}
          />
        </div>
      )}
    </div>
  );
}
