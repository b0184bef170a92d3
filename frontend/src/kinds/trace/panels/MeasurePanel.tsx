import { useQuery } from '@tanstack/react-query';
import type { Range } from '@/editors/plot/scales';
import { useText } from '@/i18n';
import { statistics, valueAt, type Statistics } from '../analysis/statistics';
import type { TraceData } from '../configuration';
import type { RunData } from '../data/runData';
import { fetchStatistics, MOST_POINTS, sourcePath } from '../data/source';
import { automaticColor } from '../diagram/ink';
import { durationText } from '@/iec/duration';
import { formatNumber } from '../numbers';
import styles from '../Trace.module.css';
import panel from './Panels.module.css';
import { channelsOf, placeIn, samplesOf, type ChannelRef } from './channels';

const LIVE_MS = 1000;

interface Row {
  ref: ChannelRef;
  at: readonly (number | null)[];
  between: Statistics | null;
}

interface MeasurePanelProps {
  data: TraceData;
  run: RunData;
  live: boolean;
  /** Moments of cursors; statistics are over the range in their place. */
  cursors: readonly number[];
  range: Range | null;
}

async function measured(
  run: RunData,
  data: TraceData,
  cursors: readonly number[],
  range: Range | null,
  signal: AbortSignal,
): Promise<Row[]> {
  return Promise.all(
    channelsOf(data).map(async (ref) => ({
      ref,
      at: await Promise.all(cursors.map((ns) => valueOf(run, data, ref, ns, signal))),
      between: range === null ? null : await statisticsOf(run, data, ref, range, signal),
    })),
  );
}

/** The sample that was valid at a moment, exactly, however coarse the picture is. */
async function valueOf(run: RunData, data: TraceData, ref: ChannelRef, ns: number, signal: AbortSignal) {
  const interval = run.interval(ref.record);
  const extent = run.extent(ref.record);
  if (extent === null || ns < extent.min || ns > extent.max + interval) return null;
  const found = await samplesOf(run, data, ref, { min: ns - 3 * interval, max: ns + interval }, 64, signal);
  return found === null ? null : valueAt(found.window.time, found.low, ns);
}

async function statisticsOf(
  run: RunData,
  data: TraceData,
  ref: ChannelRef,
  range: Range,
  signal: AbortSignal,
): Promise<Statistics | null> {
  if (ref.channel.formula.trim() !== '') {
    const found = await samplesOf(run, data, ref, range, MOST_POINTS, signal);
    return found === null || found.window.step > 1 ? null : statistics(found.low);
  }
  const place = placeIn(run, data, ref);
  if (place === null || run.origin === null) return null;
  const s = await fetchStatistics(run.source, place.record, place.number, run.origin, range, signal);
  const { count, minimum: min, maximum: max, mean, rms, deviation } = s;
  if (min === null || max === null || mean === null || rms === null || deviation === null) return null;
  return { count, min, max, mean, rms, deviation, peakToPeak: max - min };
}

function useMeasured({ data, run, live, cursors, range }: MeasurePanelProps) {
  return useQuery({
    queryKey: ['trace-measured', sourcePath(run.source), String(run.origin), cursors, range, data.records],
    queryFn: ({ signal }) => measured(run, data, cursors, range, signal),
    enabled: run.origin !== null,
    refetchInterval: live ? LIVE_MS : false,
    placeholderData: (before) => before,
    gcTime: 0,
    retry: false,
  });
}

const text = (value: number | null | undefined) => (value == null ? '–' : formatNumber(value));

function NameCell({ of }: { of: ChannelRef }) {
  return (
    <th scope="row">
      <i className={panel.swatch} style={{ background: of.channel.color || automaticColor(of.number) }} />
      {of.name}
    </th>
  );
}

/** What the cursors measure of each variable (TRC-81). */
export function MeasurePanel(props: MeasurePanelProps) {
  const t = useText();
  const { data: rows } = useMeasured(props);
  const { cursors } = props;
  if (cursors.length === 0) return <p className={styles.note}>{t('trace.noCursors')}</p>;
  const two = cursors.length === 2;
  const seconds = two ? (cursors[1]! - cursors[0]!) / 1e9 : 0;
  return (
    <table className={styles.table} aria-label={t('trace.panel.measure')}>
      <thead>
        <tr>
          <th>{t('trace.variable')}</th>
          {cursors.map((ns, number) => (
            <th key={number}>{t('trace.cursorAt', { number: number + 1, time: durationText(ns) })}</th>
          ))}
          {two && (
            <>
              <th>{`Δ (Δt ${durationText(Math.abs(cursors[1]! - cursors[0]!))})`}</th>
              <th>{t('trace.slope')}</th>
              <th>{t('trace.min')}</th>
              <th>{t('trace.max')}</th>
              <th>{t('trace.mean')}</th>
              <th>{t('trace.rms')}</th>
            </>
          )}
        </tr>
      </thead>
      <tbody>
        {rows?.map(({ ref, at, between }) => {
          const [one, other] = at;
          const apart = one == null || other == null ? null : other - one;
          return (
            <tr key={ref.key}>
              <NameCell of={ref} />
              {at.map((value, number) => (
                <td key={number}>{text(value)}</td>
              ))}
              {two && (
                <>
                  <td>{text(apart)}</td>
                  <td>{apart === null || seconds === 0 ? '–' : `${formatNumber(apart / seconds)} /s`}</td>
                  <td>{text(between?.min)}</td>
                  <td>{text(between?.max)}</td>
                  <td>{text(between?.mean)}</td>
                  <td>{text(between?.rms)}</td>
                </>
              )}
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

/** Statistics of each variable over what is seen, or between the cursors. */
export function StatisticsPanel(props: MeasurePanelProps) {
  const t = useText();
  const { data: rows } = useMeasured({ ...props, cursors: [] });
  const columns = ['count', 'min', 'max', 'peakToPeak', 'mean', 'rms', 'deviation'] as const;
  return (
    <table className={styles.table} aria-label={t('trace.panel.statistics')}>
      <thead>
        <tr>
          <th>{t('trace.variable')}</th>
          {columns.map((column) => (
            <th key={column}>{t(`trace.${column}`)}</th>
          ))}
        </tr>
      </thead>
      <tbody>
        {rows?.map(({ ref, between }) => (
          <tr key={ref.key}>
            <NameCell of={ref} />
            {columns.map((column) => (
              <td key={column}>{text(between?.[column])}</td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
