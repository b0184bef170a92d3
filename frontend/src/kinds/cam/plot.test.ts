import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { CamDrawing } from './curves';
import { drawnPoints, niceStep, shifted, snapped, tickText, ticks, valueRange, zoomed, type Range } from './plot';
import { DEFAULT_CAM } from './sampleCam';

const range: fc.Arbitrary<Range> = fc
  .record({ from: fc.integer({ min: -1e6, max: 1e6 }), width: fc.integer({ min: 1, max: 1e6 }) })
  .map(({ from, width }) => ({ min: from / 1000, max: (from + width) / 1000 }));

describe('scales', () => {
  it('have steps of 1, 2 or 5', () => {
    expect(niceStep({ min: 0, max: 360 }, 9)).toBe(50);
    expect(niceStep({ min: 0, max: 0.04 }, 4)).toBeCloseTo(0.01, 12);
    expect(niceStep({ min: 3, max: 3 }, 4)).toBe(1);
  });

  it('have about as many ticks as are wanted, all inside', () => {
    fc.assert(
      fc.property(range, fc.integer({ min: 2, max: 30 }), (shown, count) => {
        const found = ticks(shown, count);
        expect(found.length).toBeLessThanOrEqual(count + 1);
        expect(found.length).toBeGreaterThanOrEqual(Math.floor(count / 2.5) - 1);
        const size = shown.max - shown.min;
        for (const tick of found) {
          expect(tick).toBeGreaterThanOrEqual(shown.min - 1e-6 * size);
          expect(tick).toBeLessThanOrEqual(shown.max + 1e-6 * size);
        }
      }),
    );
  });

  it('name ticks with as many decimals as tell them apart', () => {
    fc.assert(
      fc.property(range, fc.integer({ min: 2, max: 12 }), (shown, count) => {
        const step = niceStep(shown, count);
        const texts = ticks(shown, count).map((tick) => tickText(tick, step));
        expect(new Set(texts).size).toBe(texts.length);
      }),
    );
    expect([0, 50, 100].map((tick) => tickText(tick, 50))).toEqual(['0', '50', '100']);
    expect(tickText(0.0025, 0.0005)).toBe('0.0025');
  });

  it('snap to a multiple that is written in few digits', () => {
    expect(snapped(0.30000000004, 0.1)).toBe(0.3);
    expect(snapped(123.4, 5)).toBe(125);
    expect(Object.is(snapped(-0.01, 5), 0)).toBe(true);
  });

  it('zoom about a place that stays, within the whole range', () => {
    fc.assert(
      fc.property(
        range,
        fc.double({ min: 0, max: 1, noNaN: true }),
        fc.double({ min: 0.2, max: 5, noNaN: true }),
        (whole, part, factor) => {
          const first = zoomed(whole, whole, whole.min + part * (whole.max - whole.min), 0.5);
          const size = whole.max - whole.min;
          expect(first.max - first.min).toBeCloseTo(size / 2, 6);
          const about = first.min + part * (first.max - first.min);
          const next = zoomed(first, whole, about, factor);
          for (const shown of [first, next, shifted(next, whole, size)]) {
            expect(shown.min).toBeGreaterThanOrEqual(whole.min - 1e-9 * Math.max(1, Math.abs(whole.min)));
            expect(shown.max).toBeLessThanOrEqual(whole.max + 1e-9 * Math.max(1, Math.abs(whole.max)));
          }
          if (next.min > whole.min && next.max < whole.max)
            expect((about - next.min) / (next.max - next.min)).toBeCloseTo(part, 6);
        },
      ),
    );
  });
});

describe('the range of a graph', () => {
  const drawing = {
    at: [],
    findings: [],
    segments: [{ x: [0, 1], y: [-5, 3], v: [2, 2], a: [0, 0], j: [7, 7] }],
  } as unknown as CamDrawing;

  it('is that of the properties for the position, and holds the curve (CAM-33)', () => {
    const shown = valueRange(DEFAULT_CAM, drawing, 'y');
    expect(shown.min).toBeLessThan(-5);
    expect(shown.max).toBeGreaterThan(360);
    expect(valueRange(DEFAULT_CAM, null, 'y').max).toBeGreaterThan(360);
  });

  it('follows the values elsewhere, with zero in it', () => {
    const shown = valueRange(DEFAULT_CAM, drawing, 'j');
    expect(shown.min).toBeLessThan(0);
    expect(shown.min).toBeGreaterThan(-2);
    expect(shown.max).toBeGreaterThan(7);
    expect(shown.max).toBeLessThan(9);
  });

  it('has a height where everything is the same', () => {
    const shown = valueRange(DEFAULT_CAM, { ...drawing, segments: [] }, 'a');
    expect(shown).toEqual({ min: -1, max: 1 });
  });
});

describe('points', () => {
  const window = { min: 0, max: 100 };

  it('are all drawn where there is room, two near ones too', () => {
    expect(drawnPoints([0, 50, 50.1, 100], window, 700, null)).toEqual([0, 1, 2, 3]);
    expect(drawnPoints([0, 50, 50.1, 100], { min: 50, max: 60 }, 700, null)).toEqual([1, 2]);
  });

  it('are left to the curve where they would overlap, but for the chosen one', () => {
    const xs = [...Array.from({ length: 900 }, (_, at) => at / 10), 95, 100];
    expect(drawnPoints(xs, window, 700, null)).toEqual([900, 901]);
    expect(drawnPoints(xs, window, 700, 3)).toEqual([3, 900, 901]);
    expect(drawnPoints(xs, { min: 1, max: 2 }, 700, null)).toHaveLength(11);
  });
});
