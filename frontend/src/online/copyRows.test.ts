import { expect, it } from 'vitest';
import { rowsAsText } from './copyRows';
import type { OnlineRow } from './treeRows';

const row = (expression: string, type: string | undefined): OnlineRow => ({
  key: expression,
  label: expression,
  expression,
  type,
  depth: 0,
  root: 0,
  open: undefined,
});

it('copies path, type and exact value of each row, and no empty line for the one that is typed into', () => {
  const rows = [row('PRG.count', 'DINT'), row('PRG.part', 'ST_Part'), row('', undefined)];
  expect(rowsAsText(rows, new Map([['PRG.count', '42']]))).toBe('PRG.count\tDINT\t42\nPRG.part\tST_Part\t');
});
