import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { numberText, shortNumber, typedNumber } from './numbers';

describe('numbers', () => {
  it('are read as they are typed', () => {
    expect([' 12 ', '1,5', '-1e3', '.5', '5.'].map(typedNumber)).toEqual([12, 1.5, -1000, 0.5, 5]);
    expect(['', 'abc', '1 2', '1,2,3', 'Infinity', '0x10'].map(typedNumber).every(Number.isNaN)).toBe(true);
  });

  it('are shown with the digits that they need', () => {
    expect([360, 0.1 + 0.2, 1e-9, 2.5e12, 0, -1.5].map(numberText)).toEqual([
      '360',
      '0.3',
      '1e-9',
      '2.5e+12',
      '0',
      '-1.5',
    ]);
    expect(numberText(Number.NaN)).toBe('');
  });

  it('are cut to a narrow column at their last digits', () => {
    expect(
      [0.3603603604, 10.00000238, 0.0000197786813, -12821.54, 120, -1234567.891].map((one) => shortNumber(one)),
    ).toEqual(['0.36036036', '10.0000024', '1.97787e-5', '-12821.54', '120', '-1234567.9']);
  });

  it('keep their size in a narrow column', () => {
    fc.assert(
      fc.property(fc.double({ noNaN: true, noDefaultInfinity: true, min: -1e12, max: 1e12 }), (value) => {
        const shown = shortNumber(value);
        expect(shown.length).toBeLessThanOrEqual(10);
        expect(Math.abs(Number(shown) - value)).toBeLessThanOrEqual(0.05 * Math.abs(value));
      }),
    );
  });
});
