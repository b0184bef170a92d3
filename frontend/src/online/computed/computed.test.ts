import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import type { PlcValue } from '../item';
import { parseComputed, type Result, type Source } from './computed';
import { literalOf } from './literals';
import { elementaryNamed, itemOf, type TypedItem } from './types';

interface Table {
  readonly declaration: readonly [string, string, string][];
  readonly cases: readonly [string, string, string | null][];
}

const table = (name: string): unknown =>
  JSON.parse(readFileSync(join(import.meta.dirname, `../../../../tests/runtime/data/${name}.json`), 'utf8'));
/** The tables that the evaluator of the runtime fulfils as well (tests/runtime/test_watch_expressions.py). */
const TABLE = table('watch_expressions') as Table & { refused: readonly [string, string][] };
const RANDOM = table('watch_random') as Table;

const MODE = { kind: 'enum', type: 'Mode', size: 2, base: 'int', enum: { Off: 0, Ready: 1, Run: 5 } };

function declared(type: string, literal: string): Source {
  if (type === 'Mode') return { item: MODE, value: 5 };
  const found = elementaryNamed(type);
  if (found === null) return { item: { kind: 'string', type, size: 81 }, value: literal };
  const given = literalOf(literal.replace(/^-/, ''))!.value;
  const value = literal.startsWith('-') ? -given : given;
  return {
    item: itemOf(found),
    value: type === 'BOOL' ? value === 1n : type === 'REAL' ? Math.fround(Number(value)) : value,
  };
}

const unknown = (path: string): Source => ({
  item: { kind: 'error', type: '', size: 0, error: `There is no ${path}.` },
  value: null,
});

function valued({ declaration }: Table) {
  const sources = new Map<string, Source>(
    declaration.map(([name, type, literal]) => [`PLC_PRG.${name}`, declared(type, literal)]),
  );
  sources.set('PLC_PRG.w.3', { item: { kind: 'bits', type: 'WORD', size: 1, bit: 3 }, value: true });
  sources.set('PLC_PRG.w.8', { item: { kind: 'bits', type: 'WORD', size: 1, bit: 0 }, value: false });
  return (text: string): Result | undefined =>
    parseComputed(text)?.evaluate((path) => sources.get(path) ?? unknown(path));
}

function check(found: Result | undefined, type: string, expected: string | null): void {
  if (expected === null) {
    expect(found).toEqual(expect.objectContaining({ kind: 'none', key: 'watch.computed.divided' }));
    return;
  }
  const value: PlcValue =
    type === 'BOOL' ? expected === 'true' : /^L?REAL$/.test(type) ? Number(expected) : BigInt(expected);
  expect(found).toEqual({ kind: 'value', value, item: itemOf(elementaryNamed(type)!) });
}

describe('watch expressions, as the runtime computes them', () => {
  const evaluate = valued(TABLE);
  it.each(TABLE.cases)('%s', (text, type, expected) => {
    check(evaluate(text), type, expected);
  });
  it.each(TABLE.refused)('%s is refused', (text, key) => {
    const found = evaluate(text);
    expect(found).toEqual(expect.objectContaining({ kind: 'wrong', key: `watch.computed.${key}` }));
  });
  const random = valued(RANDOM);
  it.each(RANDOM.cases)('%s, by numpy', (text, type, expected) => {
    check(random(text), type, expected);
  });
});

describe('watch expressions', () => {
  const int = { kind: 'int', type: 'INT', size: 2 };
  const result = (text: string, item: TypedItem, value: PlcValue | null) =>
    parseComputed(text)?.evaluate(() => ({ item, value }));

  it.each([
    ['GVL.arr[3] + GVL.arr[1,2].w', ['GVL.arr[3]', 'GVL.arr[1, 2].w']],
    ['%QW2 AND 16#0F', ['%QW2']],
    ['p^.x * .top (* from above *) + GVL.x.3', ['p^.x', '.top', 'GVL.x.3']],
    ['GVL.x * GVL.x + PLC_PRG.a', ['GVL.x', 'PLC_PRG.a']],
    ['mode = Mode#Run', ['mode', 'Mode.Run']],
    ['(PLC_PRG.a)', ['PLC_PRG.a']],
  ])('%s names its variables, each once', (text, operands) => {
    expect(parseComputed(text)?.operands).toEqual(operands);
  });

  it.each([
    'PLC_PRG.a', ' GVL.arr[3] ', '%QW2', 'PLC_PRG.a +', '(PLC_PRG.a', 'PLC_PRG.a b', 'a := 3', 'ABS()', 'MIN(a)',
    'SIN(a)', '3#1 + 1 2', 'T#1s', "'abc'", 'a[ + 1', 'a. + 1', '', `${'('.repeat(1000)}a + 1`,
  ])('%s is no expression', (text) => {
    expect(parseComputed(text)).toBeNull();
  }); // prettier-ignore

  it('wait for a value that has not come yet', () => {
    expect(parseComputed('a + 1')?.evaluate(() => null)).toEqual({ kind: 'waiting' });
    expect(result('a + 1', int, null)).toEqual({ kind: 'waiting' });
  });
  it('say what the server says of a variable', () => {
    expect(parseComputed('a + 1')?.evaluate(unknown)).toEqual({ kind: 'refused', message: 'There is no a.' });
  });
  it.each<TypedItem>([
    { kind: 'reference', type: 'REFERENCE TO INT', size: 8 },
    { kind: 'struct', type: 'Point', size: 0 },
    { kind: 'int', type: 'Odd', size: 3 },
    { kind: 'of another version', type: 'New', size: 8 },
  ])('have no number where the type is not known: $type', (item) => {
    const values = { path: 'a', type: item.type };
    expect(result('a + 1', item, 5)).toEqual({ kind: 'wrong', key: 'watch.computed.noNumber', values });
  });
  it('take a pointer as address', () => {
    const pointer = { kind: 'pointer', type: 'POINTER TO INT', size: 8 };
    expect(result('a <> 0', pointer, 4096n)).toEqual(expect.objectContaining({ value: true }));
  });
  it('round a large whole number to REAL once', () => {
    // 2^24 + 1 + 2^-30, times 2^30: by way of LREAL it would lie half way, and be rounded to even
    const item = { kind: 'int', type: 'LINT', size: 8 };
    const value = (2n ** 24n + 1n) * 2n ** 38n + 1n;
    expect(result('a + REAL#0', item, value)).toEqual(expect.objectContaining({ value: (2 ** 24 + 2) * 2 ** 38 }));
  });
});
