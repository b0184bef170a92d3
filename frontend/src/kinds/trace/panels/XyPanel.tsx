import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { Range } from '@/editors/plot/scales';
import { useText } from '@/i18n';
import { Select } from '@/ui/Field';
import { resampled } from '../analysis/compare';
import type { TraceData } from '../configuration';
import type { RunData } from '../data/runData';
import { sourcePath } from '../data/source';
import { automaticColor } from '../diagram/ink';
import styles from '../Trace.module.css';
import panel from './Panels.module.css';
import { channelsOf, samplesOf } from './channels';
import { LineChart } from './LineChart';

const MOST_SAMPLES = 8192;
const LIVE_MS = 1000;

interface XyPanelProps {
  data: TraceData;
  run: RunData;
  live: boolean;
  range: Range;
}

/** One variable over another. */
export function XyPanel({ data, run, live, range }: XyPanelProps) {
  const t = useText();
  const channels = channelsOf(data);
  const [chosen, setChosen] = useState<{ x: string | null; y: string | null }>({ x: null, y: null });
  const x = channels.find(({ key }) => key === chosen.x) ?? channels[0];
  const y = channels.find(({ key }) => key === chosen.y) ?? channels[1] ?? channels[0];
  const { data: found } = useQuery({
    queryKey: ['trace-xy', sourcePath(run.source), String(run.origin), x?.key, y?.key, range, data.records],
    queryFn: async ({ signal }) => {
      const [one, other] = await Promise.all(
        [x!, y!].map((ref) => samplesOf(run, data, ref, range, MOST_SAMPLES, signal)),
      );
      if (!one || !other) return null;
      const same = one.window.time.length === other.window.time.length && x!.record === y!.record;
      return {
        xs: one.low,
        ys: same ? other.low : resampled(other.window.time, other.low, one.window.time),
        thinned: one.window.step > 1 || other.window.step > 1,
      };
    },
    enabled: x !== undefined && y !== undefined && run.origin !== null,
    refetchInterval: live ? LIVE_MS : false,
    placeholderData: (before) => before,
    gcTime: 0,
    retry: false,
  });
  const choices = channels.map(({ key, name }) => ({ value: key, text: name }));
  return (
    <div className={panel.chartBody}>
      <div className={panel.choices}>
        {(['x', 'y'] as const).map((of) => (
          <label key={of}>
            {of.toUpperCase()}
            <Select
              label={of.toUpperCase()}
              value={(of === 'x' ? x : y)?.key ?? null}
              choices={choices}
              onValue={(key) => setChosen((before) => ({ ...before, [of]: key }))}
            />
          </label>
        ))}
        {found?.thinned && <span className={styles.muted}>{t('trace.thinned')}</span>}
      </div>
      {found && (
        <div className={panel.chartPlace} style={{ display: 'flex' }}>
          <LineChart
            label={t('trace.panel.xy')}
            xs={found.xs}
            ys={found.ys}
            color={y!.channel.color || automaticColor(y!.number)}
            xUnit={x!.name}
            yUnit={y!.name}
            ordered={false}
          />
        </div>
      )}
    </div>
  );
}
