import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Curves } from '../data/curves';
import { columnsOf, fillColumns, isDense } from './columns';
import type { Plane } from './plane';

/** Ten columns a nanosecond-unit wide; up is less. */
const plane: Plane = { left: 5, top: 0, width: 10, height: 200, toX: (ns) => 5 + ns, toY: (value) => 100 - value };

function curvesOf(time: number[], low: number[], high: number[] = low, gap: number[] = []) {
  const curve = { low: Float64Array.from(low), high: Float64Array.from(high) };
  const curves: Curves = {
    step: 1,
    time: Float64Array.from(time),
    gap: Uint8Array.from(time, (_, k) => gap[k] ?? 0),
    channels: new Map([[0, curve]]),
  };
  return { curves, curve };
}

function spans(of: ReturnType<typeof curvesOf>, base: number | null = null): (string | null)[] {
  const { top, bottom } = columnsOf(of.curves, of.curve, plane, base);
  return [...top].map((from, k) => (Number.isNaN(from) ? null : `${100 - bottom[k]!}..${100 - from}`));
}

describe('columns of a dense curve', () => {
  it('reach from the least to the greatest value of each', () => {
    expect(spans(curvesOf([0, 0.3, 0.6, 1.1, 1.9], [1, 9, 4, 5, 6])).slice(0, 3)).toEqual(['1..9', '4..6', null]);
  });

  it('touch the column before, as a line does', () => {
    expect(spans(curvesOf([0, 0.5, 1, 1.5], [0, 1, 40, 41])).slice(0, 2)).toEqual(['0..1', '1..41']);
    expect(spans(curvesOf([0, 1], [30, 5], [33, 9])).slice(0, 2)).toEqual(['30..33', '5..30']);
  });

  it('are empty where nothing was recorded', () => {
    expect(spans(curvesOf([0, 1, 4, 5], [1, 2, 50, 51], undefined, [0, 0, 1, 0])).slice(0, 6)).toEqual([
      '1..1',
      '1..2',
      null,
      null,
      '50..50',
      '50..51',
    ]);
    expect(spans(curvesOf([0, 1, 2], [1, NaN, 3])).slice(0, 3)).toEqual(['1..1', null, '3..3']);
  });

  it('slope where columns have no point of their own', () => {
    expect(spans(curvesOf([0, 4], [0, 40])).slice(0, 5)).toEqual(['0..0', '0..10', '10..20', '20..30', '30..40']);
  });

  it('reach down to zero for saw teeth', () => {
    expect(spans(curvesOf([0, 1], [5, 7]), 100)[0]).toBe('0..5');
  });

  it('cover every point and every line between two points, and nothing beside them', () => {
    const points = fc.array(
      fc.tuple(fc.double({ min: 0, max: 9.99, noNaN: true }), fc.integer({ min: -90, max: 90 })),
      {
        minLength: 2,
        maxLength: 60,
      },
    );
    fc.assert(
      fc.property(points, (found) => {
        const rising = [...found].sort((one, other) => one[0] - other[0]);
        const of = curvesOf(
          rising.map(([at]) => at),
          rising.map(([, value]) => value),
        );
        const { top, bottom } = columnsOf(of.curves, of.curve, plane);
        const drawn = (x: number, y: number) => y >= top[Math.floor(x)]! - 1e-3 && y <= bottom[Math.floor(x)]! + 1e-3;
        for (const [at, value] of rising) expect(drawn(at, 100 - value)).toBe(true);
        // No column is higher than all that a line passes in it and its neighbours.
        for (let column = 0; column < 10; column += 1) {
          if (Number.isNaN(top[column]!)) continue;
          const near = rising.flatMap(([, value], k) => {
            const [before, after] = [rising[k - 1] ?? rising[k]!, rising[k + 1] ?? rising[k]!];
            return before[0] <= column + 1 && after[0] >= column ? [value] : [];
          });
          expect(100 - bottom[column]!).toBeGreaterThanOrEqual(Math.min(...near) - 1e-3);
          expect(100 - top[column]!).toBeLessThanOrEqual(Math.max(...near) + 1e-3);
        }
      }),
    );
  });

  it('are taken where points are denser than pixels, and steep', () => {
    const dense = (time: number[], low: number[], high = low) => {
      const { curves, curve } = curvesOf(time, low, high);
      return isDense(curves, curve, plane);
    };
    expect(dense([0, 1, 2], [0, 90, 0])).toBe(true);
    expect(dense([0, 1, 2], [0, 0, 0], [50, 50, 50])).toBe(true);
    expect(dense([0, 1, 2], [0, 5, 0])).toBe(false);
    expect(dense([0, 3, 9], [0, 90, 0])).toBe(false);
    expect(dense([0], [0])).toBe(false);
  });
});

describe('filled columns', () => {
  const filled = (top: number[], bottom: number[], band = { from: 0, to: 200 }) => {
    const rects: number[][] = [];
    const context = { fillRect: (...rect: number[]) => rects.push(rect) };
    fillColumns(context, { top: Float32Array.from(top), bottom: Float32Array.from(bottom) }, 5, band, 2);
    return rects;
  };

  it('are at least as thick as the curve, and one where neighbours are equal', () => {
    expect(filled([50, 50, 50, 20], [50, 50, 50, 60])).toEqual([
      [5, 49, 3, 2],
      [8, 19, 1, 42],
    ]);
  });

  it('end at the band of their colour', () => {
    expect(filled([50, 10], [150, 20], { from: 100, to: 200 })).toEqual([[5, 100, 1, 51]]);
  });

  it('leave out empty columns', () => {
    expect(filled([NaN, 50, NaN, 50], [NaN, 50, NaN, 50])).toEqual([
      [6, 49, 1, 2],
      [8, 49, 1, 2],
    ]);
  });
});
