import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { derivative, integral } from './calculus';
import { bestShift, difference, resampled } from './compare';
import { dft, spectrum, WINDOWS } from './spectrum';
import { lowerBound, measure, nearestSample, statistics, valueAt } from './statistics';

const sampled = (count: number, step: number, of: (seconds: number) => number) => {
  const time = Float64Array.from({ length: count }, (_, k) => Math.round(k * step * 1e9));
  return { time, values: Float64Array.from(time, (ns) => of(ns / 1e9)) };
};

describe('the spectrum', () => {
  it('is that of the definition, for any length', () => {
    fc.assert(
      fc.property(fc.array(fc.double({ min: -10, max: 10, noNaN: true }), { minLength: 1, maxLength: 40 }), (x) => {
        const { re, im } = dft(x);
        for (let k = 0; k < x.length; k += 1) {
          let [sr, si] = [0, 0];
          x.forEach((value, n) => {
            sr += value * Math.cos((2 * Math.PI * k * n) / x.length);
            si -= value * Math.sin((2 * Math.PI * k * n) / x.length);
          });
          expect(re[k]).toBeCloseTo(sr, 8);
          expect(im[k]).toBeCloseTo(si, 8);
        }
      }),
    );
  });

  it.each(WINDOWS)('has the amplitude of a sine and of its mean, window %s', (window) => {
    const rate = 1000;
    for (const count of [1000, 1024, 1250]) {
      const bin = 40;
      const hz = (bin * rate) / count;
      const { values } = sampled(count, 1 / rate, (t) => 2.5 + 3 * Math.sin(2 * Math.PI * hz * t + 0.7));
      const { frequency, amplitude } = spectrum(values, rate, window);
      expect(frequency[bin]).toBeCloseTo(hz, 9);
      expect(amplitude[bin]).toBeCloseTo(3, 6);
      expect(amplitude[0]).toBeCloseTo(2.5, 6);
      expect(Math.max(...amplitude.slice(bin + 5))).toBeLessThan(1e-6);
    }
  });

  it('keeps the amplitude of a sine between two bins with the flat top within 0.01 dB', () => {
    const { values } = sampled(1000, 1e-3, (t) => Math.sin(2 * Math.PI * 50.5 * t));
    expect(Math.abs(20 * Math.log10(Math.max(...spectrum(values, 1000, 'flattop').amplitude)))).toBeLessThan(0.01);
  });

  it('has half the rate once', () => {
    const { values } = sampled(64, 1e-3, (t) => 4 * Math.cos(Math.PI * 1000 * t));
    expect(spectrum(values, 1000, 'rectangular').amplitude[32]).toBeCloseTo(4, 9);
  });
});

describe('derivative and integral', () => {
  it('are those of a parabola, which the second order meets also at uneven times', () => {
    const seconds = [0, 0.1, 0.3, 0.35, 0.8, 1];
    const time = seconds.map((s) => s * 1e9);
    const slope = derivative(
      time,
      seconds.map((s) => 3 * s * s - 2 * s + 1),
    );
    for (let k = 1; k < seconds.length - 1; k += 1) expect(slope[k]).toBeCloseTo(6 * seconds[k]! - 2, 9);
    const area = integral(
      time,
      seconds.map((s) => 4 * s),
    );
    seconds.forEach((s, k) => expect(area[k]).toBeCloseTo(2 * s * s, 9));
  });

  it('are those of a sine', () => {
    const { time, values } = sampled(2001, 1e-3, (t) => Math.sin(5 * t));
    const slope = derivative(time, values);
    const area = integral(time, values);
    for (let k = 1; k < 2000; k += 97) {
      expect(slope[k]).toBeCloseTo(5 * Math.cos((5 * k) / 1000), 3);
      expect(area[k]).toBeCloseTo((1 - Math.cos((5 * k) / 1000)) / 5, 5);
    }
  });

  it('do not reach over a gap', () => {
    const time = [0, 1e9, 2e9, 3e9, 4e9];
    const values = [1, 1, NaN, 5, 7];
    expect([...derivative(time, values)]).toEqual([0, 0, NaN, 2, 2]);
    expect([...integral(time, values)]).toEqual([0, 1, NaN, 1, 7]);
  });
});

describe('statistics', () => {
  it('are those of the definition', () => {
    fc.assert(
      fc.property(fc.array(fc.double({ min: -1e3, max: 1e3, noNaN: true }), { minLength: 1 }), (values) => {
        const found = statistics([NaN, ...values, NaN])!;
        const mean = values.reduce((sum, one) => sum + one, 0) / values.length;
        expect(found.count).toBe(values.length);
        expect(found.min).toBe(Math.min(...values));
        expect(found.max).toBe(Math.max(...values));
        expect(found.mean).toBeCloseTo(mean, 6);
        expect(found.rms).toBeCloseTo(Math.sqrt(values.reduce((sum, one) => sum + one * one, 0) / values.length), 6);
        const spread = values.reduce((sum, one) => sum + (one - mean) ** 2, 0) / values.length;
        expect(found.deviation).toBeCloseTo(Math.sqrt(spread), 5);
      }),
    );
    expect(statistics([NaN])).toBeNull();
  });

  it('of whole periods of a sine are 0 and amplitude / √2', () => {
    const { values } = sampled(1000, 1e-3, (t) => 3 * Math.sin(2 * Math.PI * 5 * t));
    const found = statistics(values)!;
    expect(found.mean).toBeCloseTo(0, 12);
    expect(found.rms).toBeCloseTo(3 / Math.SQRT2, 9);
  });
});

describe('cursors', () => {
  const { time, values } = sampled(11, 0.1, (t) => 10 * t);

  it('show the value that was valid then', () => {
    expect(valueAt(time, values, 0.25e9)).toBeCloseTo(2);
    expect(valueAt(time, values, 0.3e9)).toBeCloseTo(3);
    expect(valueAt(time, values, -1)).toBeNull();
    expect(valueAt([0, 1], [NaN, 2], 0.5)).toBeNull();
  });

  it('measure difference, slope and the statistics between, in either order', () => {
    const found = measure(time, values, 0.2e9, 0.8e9);
    expect(found.difference).toBeCloseTo(6);
    expect(found.slope).toBeCloseTo(10);
    expect(found.between!.count).toBe(7);
    expect(found.between!.mean).toBeCloseTo(5);
    const turned = measure(time, values, 0.8e9, 0.2e9);
    expect(turned.difference).toBeCloseTo(-6);
    expect(turned.slope).toBeCloseTo(10);
    expect(turned.between).toEqual(found.between);
    expect(measure(time, values, 5e8, 5e8).slope).toBeNull();
  });

  it('find the nearest sample and the first that is not before', () => {
    fc.assert(
      fc.property(fc.array(fc.integer({ min: 0, max: 100 }), { minLength: 1 }), fc.integer(), (all, at) => {
        const sorted = all.sort((one, other) => one - other);
        expect(lowerBound(sorted, at)).toBe(sorted.filter((one) => one < at).length);
        const near = Math.min(...sorted.map((one) => Math.abs(one - at)));
        expect(Math.abs(sorted[nearestSample(sorted, at)!]! - at)).toBe(near);
      }),
    );
    expect(nearestSample([], 1)).toBeNull();
  });
});

describe('the comparison of two runs', () => {
  const wave = (t: number) => Math.sin(2 * Math.PI * 3 * t) + Math.sin(2 * Math.PI * 7.3 * t) + t;

  it('is straight between samples and has nothing outside', () => {
    expect([...resampled([0, 10, 20], [0, 5, NaN], [-1, 0, 4, 10, 15, 21])]).toEqual([NaN, 0, 2, 5, NaN, NaN]);
  });

  it('finds by how much one is later, and nothing is left then', () => {
    const one = sampled(2001, 1e-3, wave);
    const later = sampled(2001, 1e-3, (t) => wave(t + 0.25));
    const shift = bestShift(one, later)!;
    expect(shift / 1e9).toBeCloseTo(0.25, 9);
    const left = difference(one, later, 0.25e9).filter((value) => !Number.isNaN(value));
    expect(left.length).toBeGreaterThan(1700);
    expect(Math.max(...left.map(Math.abs))).toBeLessThan(1e-9);
  });

  it('says nothing of straight lines', () => {
    expect(
      bestShift(
        sampled(100, 0.01, () => 1),
        sampled(100, 0.01, () => 2),
      ),
    ).toBeNull();
  });
});
