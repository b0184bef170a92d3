import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import type { Range } from '@/editors/plot/scales';
import { useText } from '@/i18n';
import { Checkbox, Select } from '@/ui/Field';
import { explain } from '@/ui/notices';
import { spectrum, WINDOWS, type Spectrum, type WindowName } from '../analysis/spectrum';
import type { TraceData } from '../configuration';
import type { RunData } from '../data/runData';
import { fetchSpectrum, MOST_POINTS, sourcePath } from '../data/source';
import { automaticColor } from '../diagram/ink';
import { frequencyText } from '../diagram/timeAxis';
import { formatNumber } from '../numbers';
import styles from '../Trace.module.css';
import panel from './Panels.module.css';
import { channelsOf, placeIn, samplesOf, type ChannelRef } from './channels';
import { LineChart } from './LineChart';

/** Up to so many samples are transformed here; more by the server. */
const MOST_SAMPLES = MOST_POINTS;
/** What is no amplitude any more, in decibels. */
const FLOOR_DB = -200;

interface SpectrumPanelProps {
  data: TraceData;
  run: RunData;
  range: Range;
}

async function spectrumOf(
  run: RunData,
  data: TraceData,
  ref: ChannelRef,
  range: Range,
  window: WindowName,
  signal: AbortSignal,
): Promise<Spectrum | null> {
  const found = await samplesOf(run, data, ref, range, MOST_SAMPLES, signal);
  if (found === null || found.low.length < 4) return null;
  const even = !found.window.gap.some((gap, k) => gap === 1 && k > 0) && !found.low.some(Number.isNaN);
  if (found.window.step === 1 && even) {
    const { time } = found.window;
    const seconds = (time[time.length - 1]! - time[0]!) / 1e9;
    return spectrum(found.low, (time.length - 1) / seconds, window);
  }
  const place = placeIn(run, data, ref);
  if (place === null || run.origin === null || ref.channel.formula.trim() !== '') return null;
  return fetchSpectrum(run.source, place.record, place.number, run.origin, range, window, signal);
}

/** The amplitude spectrum of a variable over what is seen, or between the cursors. */
export function SpectrumPanel({ data, run, range }: SpectrumPanelProps) {
  const t = useText();
  const channels = channelsOf(data);
  const [chosen, setChosen] = useState<string | null>(null);
  const [window, setWindow] = useState<WindowName>('hann');
  const [decibel, setDecibel] = useState(false);
  const ref = channels.find(({ key }) => key === chosen) ?? channels[0];
  const { data: found, error } = useQuery({
    queryKey: [
      'trace-spectrum',
      sourcePath(run.source),
      ref?.key,
      ref?.channel.variable,
      ref?.channel.formula,
      window,
      range,
    ],
    queryFn: ({ signal }) => spectrumOf(run, data, ref!, range, window, signal),
    enabled: ref !== undefined && run.origin !== null,
    placeholderData: (before) => before,
    gcTime: 0,
    retry: false,
  });
  const peak = found ? greatest(found) : null;
  return (
    <div className={panel.chartBody}>
      <div className={panel.choices}>
        <label>
          {t('trace.variable')}
          <Select
            label={t('trace.variable')}
            value={ref?.key ?? null}
            choices={channels.map(({ key, name }) => ({ value: key, text: name }))}
            onValue={setChosen}
          />
        </label>
        <label>
          {t('trace.window')}
          <Select<WindowName>
            label={t('trace.window')}
            value={window}
            choices={WINDOWS.map((value) => ({ value, text: t(`trace.window.${value}`) }))}
            onValue={setWindow}
          />
        </label>
        <Checkbox checked={decibel} onChecked={setDecibel}>
          dB
        </Checkbox>
        {peak !== null && found && (
          <span className="code">
            {t('trace.peak', {
              frequency: frequencyText(found.frequency[peak]!),
              amplitude: formatNumber(found.amplitude[peak]!),
            })}
          </span>
        )}
      </div>
      {error ? (
        <p className={styles.note}>{explain(error).text ?? explain(error).title}</p>
      ) : found ? (
        <div className={panel.chartPlace} style={{ display: 'flex' }}>
          <LineChart
            label={t('trace.panel.spectrum')}
            xs={found.frequency}
            ys={decibel ? found.amplitude.map((a) => Math.max(FLOOR_DB, 20 * Math.log10(a))) : found.amplitude}
            color={ref!.channel.color || automaticColor(ref!.number)}
            xUnit="Hz"
            yUnit={decibel ? 'dB' : t('trace.amplitude')}
            ordered
          />
        </div>
      ) : (
        <p className={styles.note}>{t('trace.noSpectrum')}</p>
      )}
    </div>
  );
}

/** The strongest frequency above 0. */
function greatest({ amplitude }: Spectrum): number | null {
  let best: number | null = null;
  for (let k = 1; k < amplitude.length; k += 1) if (best === null || amplitude[k]! > amplitude[best]!) best = k;
  return best;
}
