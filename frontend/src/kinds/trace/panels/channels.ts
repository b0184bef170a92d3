/** The variables that panels measure, and their samples. */
import type { Range } from '@/editors/plot/scales';
import { channelName, type Channel, type TraceData } from '../configuration';
import type { RunData } from '../data/runData';
import { fetchWindow, MOST_POINTS } from '../data/source';
import type { TraceWindow } from '../data/windowFormat';

export interface ChannelRef {
  key: string;
  record: number;
  number: number;
  channel: Channel;
  name: string;
}

/** All variables that are drawn; with their record where there are several. */
export function channelsOf(data: TraceData): ChannelRef[] {
  return data.records.flatMap((record, at) =>
    record.channels.flatMap((channel, number) => {
      if (!channel.visible) return [];
      const name = channelName(channel);
      return [
        {
          key: `${at}.${number}`,
          record: at,
          number,
          channel,
          name: data.records.length > 1 ? `${record.name}: ${name}` : name,
        },
      ];
    }),
  );
}

/** Where a recorded variable is in a run, and its number as the server counts; null where the run has it not. */
export function placeIn(
  run: RunData,
  data: TraceData,
  ref: ChannelRef,
): { record: number; index: number; number: number } | null {
  const record = run.recordOf(data.records[ref.record]!.name, ref.record);
  const index = record === null ? null : run.channelOf(record, ref.channel);
  return record === null || index === null ? null : { record, index, number: run.numberOf(record, index) };
}

/** Samples of a variable within a range, or minima and maxima where there are more than `most`; null where it has none. */
export async function samplesOf(
  run: RunData,
  data: TraceData,
  ref: ChannelRef,
  range: Range,
  most: number,
  signal: AbortSignal,
): Promise<{ window: TraceWindow; low: Float64Array; high: Float64Array } | null> {
  const base = run.origin;
  const formula = ref.channel.formula.trim();
  if (base === null) return null;
  if (formula !== '') {
    const record = run.recordOf(data.records[ref.record]!.name, ref.record);
    if (record === null) return null;
    const window = await run.formula(record, formula, range, signal);
    const { low, high } = window.channels[0]!;
    return { window, low, high };
  }
  const place = placeIn(run, data, ref);
  if (place === null) return null;
  const width = Math.min(most, MOST_POINTS);
  const window = await fetchWindow(run.source, place.record, base, range, width, signal, [place.number]);
  const found = window.channels[0];
  return found ? { window, low: found.low, high: found.high } : null;
}
