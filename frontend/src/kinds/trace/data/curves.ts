/** Pieces of tiles joined to the curves of one view. */
import type { Range } from '@/editors/plot/scales';
import { lowerBound } from '../analysis/statistics';
import type { Piece } from './tileStore';

export interface Curve {
  low: Float64Array;
  high: Float64Array;
}

/** The curves of a record within a view; a point is one sample where `step` is 1. */
export interface Curves {
  /** The greatest of the pieces. */
  step: number;
  time: Float64Array;
  /** Samples are missing before a point. */
  gap: Uint8Array;
  /** By index of the channel in the record. */
  channels: ReadonlyMap<number, Curve>;
}

export const NO_CURVES: Curves = { step: 1, time: new Float64Array(0), gap: new Uint8Array(0), channels: new Map() };

/**
 * The points of all pieces in order of time, each once; one point more on each side, so that lines reach the edges.
 * Two pieces of one tile, or of tiles that overlap, share no point.
 */
export function joined(pieces: readonly Piece[]): Curves {
  if (pieces.length === 0) return NO_CURVES;
  const parts: { piece: Piece; from: number; to: number }[] = [];
  let last = -Infinity;
  pieces.forEach((piece, number) => {
    const { time } = piece.window;
    let from = lowerBound(time, piece.range.min);
    if (number === 0 && from > 0 && !piece.begins) from -= 1;
    while (from < time.length && time[from]! <= last) from += 1;
    let to = lowerBound(time, piece.range.max);
    if (number === pieces.length - 1 && to < time.length) to += 1;
    if (from >= to) return;
    parts.push({ piece, from, to });
    last = piece.window.end[to - 1]!;
  });
  const count = parts.reduce((sum, { from, to }) => sum + to - from, 0);
  const time = new Float64Array(count);
  const gap = new Uint8Array(count);
  const indices = [...new Set(pieces.flatMap(({ window }) => window.channels.map(({ index }) => index)))];
  const channels = new Map<number, Curve>(
    indices.map((index) => [
      index,
      { low: new Float64Array(count).fill(NaN), high: new Float64Array(count).fill(NaN) },
    ]),
  );
  let at = 0;
  for (const { piece, from, to } of parts) {
    const { window } = piece;
    time.set(window.time.subarray(from, to), at);
    gap.set(window.gap.subarray(from, to), at);
    for (const channel of window.channels) {
      const curve = channels.get(channel.index)!;
      curve.low.set(channel.low.subarray(from, to), at);
      curve.high.set(channel.high.subarray(from, to), at);
    }
    at += to - from;
  }
  return { step: Math.max(...pieces.map(({ window }) => window.step)), time, gap, channels };
}

/** The range of the values of a curve within a time range; null where it has none. */
export function valueRange(curves: Curves, channel: number, view: Range): Range | null {
  const curve = curves.channels.get(channel);
  if (!curve) return null;
  let [min, max] = [Infinity, -Infinity];
  const to = Math.min(curves.time.length, lowerBound(curves.time, view.max) + 1);
  for (let k = Math.max(0, lowerBound(curves.time, view.min) - 1); k < to; k += 1) {
    const [low, high] = [curve.low[k]!, curve.high[k]!];
    if (low < min) min = low;
    if (high > max) max = high;
  }
  return min <= max ? { min, max } : null;
}
