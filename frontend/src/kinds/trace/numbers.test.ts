import { describe, expect, it } from 'vitest';
import { formatBytes } from './numbers';

describe('sizes of files', () => {
  it('have the unit that fits, and a digit behind the point where they are small', () => {
    const sizes = [0, 1023, 1024, 1536, 10 * 2 ** 10, 655_360, 21.4 * 2 ** 20, 20 * 2 ** 30, 2 ** 52];
    expect(sizes.map(formatBytes)).toEqual([
      '0 B',
      '1023 B',
      '1 KiB',
      '1.5 KiB',
      '10 KiB',
      '640 KiB',
      '21 MiB',
      '20 GiB',
      '4096 TiB',
    ]);
  });
});
