import { describe, expect, it } from 'vitest';
import { numberText, typedNumber } from './numbers';

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
});
