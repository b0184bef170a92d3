import { describe, expect, it } from 'vitest';
import { countText, microsNumber, microsText } from './times';

describe('times', () => {
  it('take the unit that fits', () => {
    expect([0.84, 412.4, 1250, 20_000, 2_400_000].map(microsText)).toEqual([
      '0.8 µs',
      '412 µs',
      '1.25 ms',
      '20.0 ms',
      '2.4 s',
    ]);
  });
  it('say when there is none', () => {
    expect(microsText(null)).toBe('–');
    expect(microsNumber(undefined)).toBe('–');
  });
});

describe('counts', () => {
  it('are grouped', () => {
    expect([7, 1234, 12_408_113].map(countText)).toEqual(['7', '1\u202f234', '12\u202f408\u202f113']);
  });
});
