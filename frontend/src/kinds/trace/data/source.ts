/** Where samples come from: a trace that runs in a controller, or a stored recording. Both answer alike. */
import { requestAny, requestBytes } from '@/api/client';
import type { Range } from '@/editors/plot/scales';
import type { Schemas } from '@/api/types';
import type { WindowName } from '../analysis/spectrum';
import { originOf, readWindow, type TraceWindow } from './windowFormat';

export type Source = { kind: 'running'; runtimeId: string; name: string } | { kind: 'stored'; id: string };

export type RecordingInfo = Schemas['RecordingInfo'];
export type Recording = Schemas['Recording'];
export type Recordings = Schemas['RecordingList'];
export type TraceState = Schemas['TraceState'];
/** What hinders a download, as the problem `trace-invalid` lists it. */
export interface DownloadProblem {
  record: number;
  channel: number | null;
  field: string;
  message: string;
}

const part = encodeURIComponent;
export const tracesPath = (runtimeId: string) => `/api/v1/runtimes/${part(runtimeId)}/traces`;
export const RECORDINGS = '/api/v1/recordings';

export function sourcePath(source: Source): string {
  return source.kind === 'running'
    ? `${tracesPath(source.runtimeId)}/${part(source.name)}`
    : `${RECORDINGS}/${part(source.id)}`;
}

type Query = Readonly<Record<string, string | number | undefined>>;

export function withQuery(path: string, query: Query): string {
  const given = Object.entries(query).filter((entry): entry is [string, string | number] => entry[1] !== undefined);
  const text = new URLSearchParams(given.map(([name, value]) => [name, String(value)])).toString();
  return text === '' ? path : `${path}?${text}`;
}

/** A request below the source; the answer has the shape that is named. */
export async function ask<Answer>(path: string, signal: AbortSignal = new AbortController().signal): Promise<Answer> {
  return (await requestAny('get', path, undefined, signal)) as Answer;
}

export async function act<Answer>(verb: 'post' | 'put' | 'patch' | 'delete', path: string, body?: unknown) {
  return (await requestAny(verb, path, body, new AbortController().signal)) as Answer;
}

/** Times of the server are nanoseconds of Unix time, which a double cannot hold. */
const LAST_MOMENT = (1n << 63n) - 1n;
function unix(ns: number, base: bigint): string {
  const moment = base + BigInt(Math.round(ns));
  return String(moment < 0n ? 0n : moment > LAST_MOMENT ? LAST_MOMENT : moment);
}
export const edges = (range: Range, base: bigint) => ({ from: unix(range.min, base), to: unix(range.max, base) });

/** The part of a record within a range, with about as many points as `width`. */
export async function fetchWindow(
  source: Source,
  record: number,
  base: bigint,
  range: Range,
  width: number,
  signal: AbortSignal,
  /** Among the recorded variables; all where none are named. */
  channels: readonly number[] = [],
): Promise<TraceWindow> {
  const chosen = channels.length === 0 ? undefined : channels.join(',');
  const path = withQuery(`${sourcePath(source)}/window`, { record, ...edges(range, base), width, channels: chosen });
  return readWindow(await requestBytes(path, signal), base);
}

export type Operation = 'derivative' | 'integral';
/** The server answers with no more points. */
export const MOST_POINTS = 20_000;

export async function fetchDerived(
  source: Source,
  of: { record: number; channel: number; operation: Operation },
  base: bigint,
  range: Range,
  width: number,
  signal: AbortSignal,
): Promise<TraceWindow> {
  const path = withQuery(`${sourcePath(source)}/derived`, { ...of, ...edges(range, base), width });
  return readWindow(await requestBytes(path, signal), base);
}

/** What there is of a record: the smallest answer; `base` is its first moment where none was known, null without samples. */
export async function fetchExtent(source: Source, record: number, base: bigint | null, signal: AbortSignal) {
  const bytes = await requestBytes(withQuery(`${sourcePath(source)}/window`, { record, width: 1 }), signal);
  const origin = originOf(bytes);
  const window = readWindow(bytes, base ?? origin);
  return { base: base ?? (window.samples > 0 ? origin : null), window };
}

export function fetchStatistics(
  source: Source,
  record: number,
  channel: number,
  base: bigint,
  range: Range,
  signal: AbortSignal,
): Promise<Schemas['ChannelStatistics']> {
  return ask(withQuery(`${sourcePath(source)}/statistics`, { record, channel, ...edges(range, base) }), signal);
}

const SERVER_WINDOWS: Readonly<Record<WindowName, string>> = {
  rectangular: 'rectangular',
  hann: 'hann',
  hamming: 'hamming',
  blackman: 'blackman',
  flattop: 'flat_top',
};

export async function fetchSpectrum(
  source: Source,
  record: number,
  channel: number,
  base: bigint,
  range: Range,
  window: WindowName,
  signal: AbortSignal,
): Promise<{ frequency: Float64Array; amplitude: Float64Array }> {
  const query = { record, channel, window: SERVER_WINDOWS[window], ...edges(range, base) };
  const found = await ask<Schemas['ChannelSpectrum']>(withQuery(`${sourcePath(source)}/spectrum`, query), signal);
  return {
    frequency: Float64Array.from(found.amplitudes, (_, k) => k * found.step_hz),
    amplitude: Float64Array.from(found.amplitudes),
  };
}
