import fc from 'fast-check';
import { describe, expect, it, vi } from 'vitest';
import type { Range } from '@/editors/plot/scales';
import { joined, valueRange } from './curves';
import { levelOf, TILE_POINTS, TileStore } from './tileStore';
import { originOf, readWindow, type TraceWindow } from './windowFormat';

/** An answer of the server, written by hand from the description of the format. */
function answer(header: object, arrays: number[][], gap: number[]): ArrayBuffer {
  let text = JSON.stringify(header);
  while ((4 + new TextEncoder().encode(text).length) % 8 !== 0) text += ' ';
  const head = new TextEncoder().encode(text);
  const buffer = new ArrayBuffer(4 + head.length + 8 * arrays.flat().length + gap.length);
  const view = new DataView(buffer);
  view.setUint32(0, head.length, true);
  new Uint8Array(buffer).set(head, 4);
  arrays.flat().forEach((value, k) => view.setFloat64(4 + head.length + 8 * k, value, true));
  new Uint8Array(buffer).set(gap, buffer.byteLength - gap.length);
  return buffer;
}

const ORIGIN = 1_700_000_000_000_000_000n;
const header = {
  count: 3,
  step: 1,
  first: 7,
  samples: 3,
  origin_ns: String(ORIGIN),
  start_ns: String(ORIGIN + 1_000_000n),
  end_ns: String(ORIGIN + 3_000_001n),
  trigger_ns: null,
  channels: [{ index: 4, name: 'ü', type: 'LREAL' }],
};

describe('an answer', () => {
  it('has samples with their times after the base', () => {
    const buffer = answer(
      header,
      [
        [0.001, 0.002, 0.003000001],
        [1, NaN, 3],
      ],
      [0, 0, 1],
    );
    expect(originOf(buffer)).toBe(ORIGIN);
    const window = readWindow(buffer, ORIGIN - 5n);
    expect([...window.time]).toEqual([1_000_005, 2_000_005, 3_000_006]);
    expect(window.extent).toEqual({ min: 1_000_005, max: 3_000_006 });
    expect(window.trigger).toBeNull();
    expect([...window.gap]).toEqual([0, 0, 1]);
    expect(window.channels).toHaveLength(1);
    expect([...window.channels[0]!.low]).toEqual([1, NaN, 3]);
    expect(window.channels[0]!.high).toBe(window.channels[0]!.low);
  });

  it('has minima and maxima where a point is many samples', () => {
    const two = [...header.channels, { index: 5, name: 'b', type: 'INT' }];
    const window = readWindow(
      answer(
        { ...header, count: 1, step: 10, channels: two, trigger_ns: String(ORIGIN + 9n) },
        [[1], [2], [-1], [-2], [10], [20]].map((one) => one),
        [1],
      ),
      ORIGIN,
    );
    expect([window.time[0], window.end[0], window.trigger]).toEqual([1e9, 2e9, 9]);
    expect(window.channels.map(({ low, high }) => [low[0], high[0]])).toEqual([
      [-1, -2],
      [10, 20],
    ]);
  });
});

/** A recording: value of sample k is k, one each `interval`; the server of it answers with minima and maxima. */
function recording(count: number, interval: number) {
  const asked: Range[] = [];
  const fetchWindow = (range: Range, width: number): Promise<TraceWindow> => {
    asked.push(range);
    const first = Math.max(0, Math.ceil(range.min / interval));
    const last = Math.min(count - 1, Math.floor(range.max / interval));
    const step = Math.max(1, Math.ceil((last - first + 1) / width));
    const points = Array.from(
      { length: Math.max(0, Math.ceil((last - first + 1) / step)) },
      (_, k) => first + k * step,
    );
    const low = Float64Array.from(points);
    const high = Float64Array.from(points, (k) => Math.min(last, k + step - 1));
    return Promise.resolve({
      step,
      first,
      samples: count,
      extent: { min: 0, max: (count - 1) * interval },
      trigger: null,
      time: low.map((k) => k * interval),
      end: high.map((k) => k * interval),
      gap: new Uint8Array(points.length),
      channels: [{ index: 0, name: 'k', type: 'LINT', low, high: step === 1 ? low : high }],
    });
  };
  return { asked, fetchWindow };
}

const settled = (store: TileStore, view: Range, pixels: number) =>
  vi.waitFor(() => {
    store.pieces(view, pixels);
    if (!store.complete(view, pixels)) throw new Error('not yet');
  });

describe('tiles', () => {
  it('are as fine as the pixels', () => {
    fc.assert(
      fc.property(
        fc.double({ min: 1e4, max: 1e18, noNaN: true }),
        fc.integer({ min: 50, max: 4000 }),
        (span, pixels) => {
          const tile = 2 ** levelOf({ min: 0, max: span }, pixels);
          const pixelsOfTile = (tile / span) * pixels;
          expect(pixelsOfTile).toBeGreaterThanOrEqual(TILE_POINTS / 2 - 1e-6);
          expect(pixelsOfTile).toBeLessThanOrEqual(TILE_POINTS + 1e-6);
        },
      ),
    );
  });

  it('give every sample of any view once, in order, with one before and behind it', async () => {
    await fc.assert(
      fc.asyncProperty(
        fc.integer({ min: 2, max: 3000 }),
        fc.integer({ min: 1, max: 5_000_000 }),
        fc.double({ min: 0, max: 0.9, noNaN: true }),
        fc.double({ min: 0.001, max: 0.5, noNaN: true }),
        fc.integer({ min: 200, max: 1500 }),
        async (count, interval, from, part, pixels) => {
          const { fetchWindow } = recording(count, interval);
          const store = new TileStore(fetchWindow, interval, () => undefined);
          const length = count * interval;
          const view = { min: from * length, max: (from + part) * length + 1 };
          await settled(store, view, pixels);
          const curves = joined(store.pieces(view, pixels));
          const times = [...curves.time];
          expect(times).toEqual([...times].sort((one, other) => one - other));
          expect(new Set(times).size).toBe(times.length);
          const inside = (k: number) => k * interval >= view.min && k * interval <= view.max;
          const seen = Array.from({ length: count }, (_, k) => k).filter(inside);
          const { low, high } = curves.channels.get(0)!;
          const covered = new Set<number>();
          low.forEach((first, at) => {
            for (let k = first; k <= high[at]!; k += 1) covered.add(k);
          });
          for (const k of seen) expect(covered.has(k)).toBe(true);
          if (curves.step === 1 && seen.length > 0) {
            if (seen[0]! > 0) expect(covered.has(seen[0]! - 1)).toBe(true);
            if (seen.at(-1)! < count - 1) expect(covered.has(seen.at(-1)! + 1)).toBe(true);
          }
        },
      ),
      { numRuns: 30 },
    );
  });

  it('draw what is coarser while the finer ones come', async () => {
    const { fetchWindow } = recording(1_000_000, 1_000_000);
    const store = new TileStore(fetchWindow, 1_000_000, () => undefined);
    const whole = { min: 0, max: 1e12 };
    await settled(store, whole, 1000);
    const near = { min: 3e11, max: 3.01e11 };
    const coarse = joined(store.pieces(near, 1000));
    expect(coarse.time.length).toBeGreaterThan(0);
    expect(coarse.step).toBeGreaterThan(100);
    await settled(store, near, 1000);
    expect(joined(store.pieces(near, 1000)).step).toBe(1);
  });

  it('draw what is finer where nothing else is there', async () => {
    const { fetchWindow } = recording(100_000, 1_000_000);
    const store = new TileStore(fetchWindow, 1_000_000, () => undefined);
    await settled(store, { min: 0, max: 1e9 }, 1000);
    expect(joined(store.pieces({ min: 0, max: 1.9e9 }, 1000)).time.length).toBeGreaterThan(500);
  });

  it('are fetched again after more samples only where they were not complete', async () => {
    const { asked, fetchWindow } = recording(10_000, 1_000_000);
    const store = new TileStore(fetchWindow, 1_000_000, () => undefined);
    const view = { min: 0, max: 20e9 };
    const pixels = 4000;
    const seen = Math.floor(20e9 / 2 ** levelOf(view, pixels)) + 1;
    await settled(store, view, pixels);
    await vi.waitFor(() => expect(asked.length).toBeGreaterThanOrEqual(seen + 3));
    const before = asked.length;
    store.pieces(view, pixels);
    expect(asked.length).toBe(before);
    store.grown();
    store.pieces(view, pixels);
    await vi.waitFor(() => expect(asked.length).toBeGreaterThan(before));
    expect(asked.length - before).toBeLessThan(seen);
  });

  it('need no more memory for more', async () => {
    const { fetchWindow } = recording(50_000_000, 1_000);
    const store = new TileStore(fetchWindow, 1_000, () => undefined);
    for (let k = 0; k < 1500; k += 1) {
      store.pieces({ min: k * 3e6, max: k * 3e6 + 4e5 }, 1200);
      await Promise.resolve();
    }
    expect(store.size.bytes).toBeLessThanOrEqual(96 * 2 ** 20);
    store.close();
  });

  it('say what failed, and ask again only when told to', async () => {
    let broken = true;
    const { asked, fetchWindow } = recording(100, 1_000_000);
    const store = new TileStore(
      (range, width) => {
        const found = fetchWindow(range, width);
        return broken ? Promise.reject(new Error('gone')) : found;
      },
      1_000_000,
      () => undefined,
    );
    const view = { min: 0, max: 1e8 };
    store.pieces(view, 1000);
    await vi.waitFor(() => expect(store.failure).toEqual(new Error('gone')));
    const before = asked.length;
    store.pieces(view, 1000);
    expect(asked.length).toBe(before);
    broken = false;
    store.retry();
    await settled(store, view, 1000);
    expect(store.failure).toBeNull();
  });
});

describe('the range of the values', () => {
  it('is that within the view', async () => {
    const { fetchWindow } = recording(1000, 1_000_000);
    const store = new TileStore(fetchWindow, 1_000_000, () => undefined);
    const view = { min: 1e8, max: 2e8 };
    await settled(store, view, 1000);
    const curves = joined(store.pieces(view, 1000));
    expect(valueRange(curves, 0, view)).toEqual({ min: 99, max: 200 });
    expect(valueRange(curves, 1, view)).toBeNull();
  });
});
