/** The last minute of watched values for sparklines: rings of samples, nothing of React. */
import type { PlcValue } from '../item';

export const HISTORY_MS = 60_000;
/** Four samples a second are more than a sparkline has pixels. */
export const SAMPLE_MS = 250;

interface Sample {
  readonly at: number;
  readonly value: number;
}

/** What a sparkline shows. */
export interface HistoryView {
  readonly samples: readonly Sample[];
  readonly min: number;
  readonly max: number;
}

/** A value as a height; null for what has none. */
export function heightOf(value: PlcValue | null): number | null {
  if (value === null || typeof value === 'string') return null;
  const height = Number(value);
  return Number.isFinite(height) ? height : null;
}

export class ValueHistory {
  private readonly rings = new Map<string, Sample[]>();

  /** Notes the values of a moment; what is not among them any more is forgotten. */
  note(at: number, values: ReadonlyMap<string, number | null>): void {
    for (const key of this.rings.keys()) if (!values.has(key)) this.rings.delete(key);
    for (const [key, value] of values) {
      const ring = this.rings.get(key) ?? [];
      this.rings.set(key, ring);
      if (value !== null) ring.push({ at, value });
      while (ring.length > 0 && at - ring[0]!.at > HISTORY_MS) ring.shift();
    }
  }

  view(key: string): HistoryView | null {
    const samples = this.rings.get(key);
    if (samples === undefined || samples.length === 0) return null;
    let min = Infinity;
    let max = -Infinity;
    for (const { value } of samples) {
      if (value < min) min = value;
      if (value > max) max = value;
    }
    return { samples, min, max };
  }
}

/** Corners of the curve in a box: the newest sample is at the right edge, the smallest at the lower one. */
export function curve(
  { samples, min, max }: HistoryView,
  now: number,
  width: number,
  height: number,
): [number, number][] {
  const tall = max - min;
  return samples.map(({ at, value }) => [
    width * (1 - (now - at) / HISTORY_MS),
    tall === 0 ? height / 2 : height * (1 - (value - min) / tall),
  ]);
}
