import { describe, expect, it } from 'vitest';
import { nextSorting, rowAfterKey, sorted, type Column } from './table';

const columns: Column<{ n: number; s: string }>[] = [
  { id: 'n', title: '', width: 10, cell: () => null, sort: (item) => item.n },
  { id: 's', title: '', width: 10, cell: () => null, sort: (item) => item.s },
];
const items = [
  { n: 2, s: 'a10' },
  { n: 1, s: 'a9' },
  { n: 2, s: 'a1' },
];

describe('tables', () => {
  it('sort numbers as numbers and texts with numbers in them naturally', () => {
    expect(sorted(items, columns, { column: 'n', descending: true }).map((item) => item.s)).toEqual([
      'a10',
      'a1',
      'a9',
    ]);
    expect(sorted(items, columns, { column: 's', descending: false }).map((item) => item.s)).toEqual([
      'a1',
      'a9',
      'a10',
    ]);
    expect(sorted(items, columns, null)).toBe(items);
  });

  it('turn the order with each click and then leave it', () => {
    const first = nextSorting(null, 'n');
    const second = nextSorting(first, 'n');
    expect([first, second, nextSorting(second, 'n')]).toEqual([
      { column: 'n', descending: false },
      { column: 'n', descending: true },
      null,
    ]);
    expect(nextSorting(second, 's')).toEqual({ column: 's', descending: false });
  });

  it('go through rows by key', () => {
    expect(rowAfterKey('ArrowDown', -1, 3, 10)).toBe(0);
    expect(rowAfterKey('ArrowUp', -1, 3, 10)).toBe(2);
    expect(rowAfterKey('PageDown', 0, 3, 10)).toBe(2);
    expect(rowAfterKey('x', 0, 3, 10)).toBeNull();
    expect(rowAfterKey('Home', 0, 0, 10)).toBeNull();
  });
});
