import { describe, expect, it } from 'vitest';
import { parseComputed } from '../computed/computed';
import type { OnlineRow } from '../treeRows';
import { curve, HISTORY_MS, heightOf, ValueHistory } from './history';
import { forcesFrom, forcesText, listFrom, listText } from './listFile';
import { differs, literalsOf, snapshotsCsv } from './snapshot';

const row = (expression: string, more: Partial<OnlineRow> = {}): OnlineRow => ({
  key: expression,
  expression,
  label: expression,
  depth: 0,
  root: 0,
  open: undefined,
  leaf: true,
  ...more,
});
const value = (expression: string, literal: string, plain: unknown, type: string) => ({
  expression,
  literal,
  value: plain,
  type,
  kind: 'int',
  size: 2,
  enum: null,
  base: null,
  forced: false,
  error: null,
});

describe('files', () => {
  it('hold a list with its formats', () => {
    const entries = [{ expression: 'PLC_PRG.a', format: 'hex' as const }, { expression: 'PLC_PRG.a + 1' }];
    expect(listText(entries)).toBe('PLC_PRG.a\thex\nPLC_PRG.a + 1\n');
    expect(listFrom(listText(entries))).toEqual(entries);
    expect(listFrom('// Pumps\r\n\r\nGVL.x\tunknown\r\n')).toEqual([{ expression: 'GVL.x' }]);
  });
  it('hold forces as assignments', () => {
    const forces = [
      { expression: 'PLC_PRG.i', literal: '5' },
      { expression: 'GVL.s', literal: "'a := b;'" },
    ];
    expect(forcesFrom(forcesText(forces))).toEqual({ forces, wrong: [] });
    expect(forcesFrom('PLC_PRG.x = 3\n\nPLC_PRG.y := TRUE')).toEqual({
      forces: [{ expression: 'PLC_PRG.y', literal: 'TRUE' }],
      wrong: [1],
    });
  });
});

describe('snapshots', () => {
  const rows = [
    row('a', { type: 'INT', comment: 'first, "best"' }),
    row('b'),
    row('a + b', { computed: parseComputed('a + b')! }),
  ];
  const at = (a: number, b: number) => ({
    at: new Date(0),
    literals: literalsOf(rows, ['a', 'b'], [value('a', String(a), a, 'INT'), value('b', String(b), b, 'INT')]),
  });
  it('have the values of one cycle, those of expressions among them', () => {
    expect([...at(2, 3).literals]).toEqual([
      ['A', '2'],
      ['B', '3'],
      ['A+B', '5'],
    ]);
  });
  it('tell which rows have changed', () => {
    expect(rows.map((one) => differs(at(2, 3), at(2, 4), one))).toEqual([false, true, true]);
    expect(differs(undefined, at(1, 1), rows[0]!)).toBe(false);
  });
  it.each([
    ['NOT a', 'WORD', 'bits', 2, 255, '16#00FF', '65280'],
    ['a + 1', 'LINT', 'int', 8, -9007199254740992, '-9007199254740993', '-9007199254740992'],
    ['a MOD 10', 'ULINT', 'uint', 8, 18446744073709552000, '16#FFFFFFFFFFFFFFFF', '5'],
    ['a * 2', 'TIME', 'time', 4, 1500, 'T#1s500ms', 'T#3s'],
    ['a - 1', 'LREAL', 'real', 8, null, '-Infinity', '-Inf'],
    ['a + 1', 'REAL', 'real', 4, null, 'NaN', 'NaN'],
    ['a = Run', 'Mode', 'enum', 2, 5, 'Run', 'TRUE'],
    ['a / 0', 'UINT', 'uint', 2, 5, '5', null],
    ['a + 1', 'STRING', 'string', 81, 'x', "'x'", null],
  ])('compute %s of a %s in its type', (text, type, kind, size, plain, literal, expected) => {
    const read = { ...value('a', literal, plain, type), kind, size };
    const typed = kind === 'enum' ? { ...read, base: 'int', enum: { Off: 0, Run: 5 } } : read;
    const found = literalsOf([row(text, { computed: parseComputed(text)! })], ['a'], [typed]);
    expect([...found.values()]).toEqual([expected]);
  });
  it('are written as CSV', () => {
    expect(snapshotsCsv(rows, [at(2, 3)])).toBe(
      'Expression,Type,1970-01-01T00:00:00.000Z,Comment\r\na,INT,2,"first, ""best"""\r\nb,,3,\r\na + b,,5,\r\n',
    );
  });
});

describe('history', () => {
  it('keeps a minute, with the smallest and the largest value', () => {
    const history = new ValueHistory();
    for (let second = 0; second <= 90; second += 1) history.note(second * 1000, new Map([['a', second % 50]]));
    const view = history.view('a')!;
    expect(view.samples[0]!.at).toBe(90_000 - HISTORY_MS);
    expect([view.min, view.max]).toEqual([0, 49]);
    history.note(91_000, new Map());
    expect(history.view('a')).toBeNull();
  });
  it('is drawn from the oldest at the left to the newest at the right', () => {
    const history = new ValueHistory();
    history.note(0, new Map([['a', 1]]));
    history.note(HISTORY_MS, new Map([['a', 3]]));
    expect(curve(history.view('a')!, HISTORY_MS, 100, 10)).toEqual([
      [0, 10],
      [100, 0],
    ]);
  });
  it('has no height for texts', () => {
    expect([heightOf(true), heightOf(5n), heightOf('x'), heightOf(NaN), heightOf(null)]).toEqual([
      1,
      5,
      null,
      null,
      null,
    ]);
  });
});
