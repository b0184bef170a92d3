import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { durationText, signedDuration, timeLiteral } from './duration';

describe('durations', () => {
  it('are TIME literals with units from large to small', () => {
    expect(timeLiteral('T#1s500ms')).toBe(1_500_000_000);
    expect(timeLiteral('time#2m')).toBe(120e9);
    expect(timeLiteral('t#0.5ms')).toBe(500_000);
    expect(['t#', 't#5', 't#5ms1s', '5ms', 'abc', 't#1s1s'].map(timeLiteral)).toEqual([
      null,
      null,
      null,
      null,
      null,
      null,
    ]);
  });

  it('have a limit for every unit but the first, and a fraction only at the end (LTYP-33)', () => {
    expect(timeLiteral('t#90m')).toBe(5400e9);
    expect(timeLiteral('t#1h59m59.5s')).toBe(7199.5e9);
    expect(['t#1h60m', 't#1d24h', 't#1.5h30m', 't#1s1000ms'].filter((text) => timeLiteral(text) !== null)).toEqual([]);
  });

  it('are written with units from large to small', () => {
    expect([0, 1, 1500e6, 90e9, -250e3, 90061e9].map(durationText)).toEqual([
      'T#0s',
      'T#1ns',
      'T#1s500ms',
      'T#1m30s',
      'T#-250us',
      'T#1d1h1m1s',
    ]);
  });

  it('are read as they are written', () => {
    fc.assert(
      fc.property(fc.integer({ min: -(2 ** 52), max: 2 ** 52 }), (ns) => {
        expect(signedDuration(durationText(ns))).toBe(ns);
      }),
    );
  });
});
