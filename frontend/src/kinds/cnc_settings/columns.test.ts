/** Order and visibility of the columns (CNCS-11). */
import { describe, expect, it } from 'vitest';
import { movedColumn, toggledColumns, type TableColumns } from './columns';

const COLUMNS: TableColumns = [
  { name: 'n', visible: true },
  { name: 'x', visible: false },
  { name: 'y', visible: true },
];

describe('CNCS-11 columns', () => {
  it('move up and down within the list', () => {
    expect(movedColumn(COLUMNS, 2, 1)?.map(({ name }) => name)).toEqual(['n', 'y', 'x']);
    expect(movedColumn(COLUMNS, 0, 1)?.map(({ name }) => name)).toEqual(['x', 'n', 'y']);
    expect([movedColumn(COLUMNS, 0, -1), movedColumn(COLUMNS, 2, 3), movedColumn(COLUMNS, 1, 1)]).toEqual([
      null,
      null,
      null,
    ]);
  });
  it('are shown together, and hidden where all were shown', () => {
    const shown = toggledColumns(COLUMNS, new Set([0, 1]));
    expect(shown.map(({ visible }) => visible)).toEqual([true, true, true]);
    expect(toggledColumns(shown, new Set([0, 1])).map(({ visible }) => visible)).toEqual([false, false, true]);
  });
});
