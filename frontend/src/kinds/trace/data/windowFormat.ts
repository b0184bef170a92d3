/**
 * The answer of the server to a part of a recording: a header in JSON, then arrays of doubles, little endian.
 *
 * A point is a sample, or, where `step` is greater than 1, the minima and maxima of that many samples. Times are
 * nanoseconds after the `base` that the caller chooses, so that they keep their digits.
 */

export interface WindowChannel {
  /** In the channels of the record. */
  index: number;
  name: string;
  type: string;
  /** Of one sample the same array. */
  low: Float64Array;
  high: Float64Array;
}

export interface TraceWindow {
  /** Samples per point. */
  step: number;
  /** Number of the first sample, counted from the start of the recording. */
  first: number;
  /** Samples in store. */
  samples: number;
  /** Of the whole store; null where it is empty. */
  extent: { min: number; max: number } | null;
  trigger: number | null;
  time: Float64Array;
  /** Of the last sample of each point. */
  end: Float64Array;
  /** 1 where samples are missing before a point. */
  gap: Uint8Array;
  channels: readonly WindowChannel[];
}

interface Header {
  count: number;
  step: number;
  first: number;
  samples: number;
  origin_ns: string;
  start_ns: string | null;
  end_ns: string | null;
  trigger_ns: string | null;
  channels: { index: number; name: string; type: string }[];
}

const PER_SECOND = 1e9;

function headerOf(buffer: ArrayBuffer): { header: Header; at: number } {
  const length = new DataView(buffer).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(buffer, 4, length));
  return { header: JSON.parse(text) as Header, at: 4 + length };
}

/** The moment that times of the answer count from, in nanoseconds of Unix time. */
export function originOf(buffer: ArrayBuffer): bigint {
  return BigInt(headerOf(buffer).header.origin_ns);
}

export function readWindow(buffer: ArrayBuffer, base: bigint): TraceWindow {
  const { header, at } = headerOf(buffer);
  const { count, step } = header;
  const origin = Number(BigInt(header.origin_ns) - base);
  const moment = (ns: string) => Number(BigInt(ns) - base);
  let offset = at;
  const doubles = (): Float64Array => {
    const values = new Float64Array(buffer, offset, count);
    offset += 8 * count;
    return values;
  };
  const times = () => doubles().map((seconds) => origin + Math.round(seconds * PER_SECOND));
  const time = times();
  const end = step > 1 ? times() : time;
  const low = header.channels.map(doublesPair(step, doubles));
  return {
    step,
    first: header.first,
    samples: header.samples,
    extent:
      header.start_ns === null || header.end_ns === null || header.samples === 0
        ? null
        : { min: moment(header.start_ns), max: moment(header.end_ns) },
    trigger: header.trigger_ns === null ? null : moment(header.trigger_ns),
    time,
    end,
    channels: header.channels.map((channel, k) => ({ ...channel, ...low[k]! })),
    gap: new Uint8Array(buffer, offset, count),
  };
}

function doublesPair(step: number, doubles: () => Float64Array): () => { low: Float64Array; high: Float64Array } {
  return () => {
    const low = doubles();
    return { low, high: step > 1 ? doubles() : low };
  };
}
