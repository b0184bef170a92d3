import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { operandOf, parseComputed, type Operand } from './computed';

const VALUES: Readonly<Record<string, Operand>> = {
  'PLC_PRG.a': 7n,
  'PLC_PRG.b': -2n,
  'GVL.x': 1.5,
  'GVL.on': true,
  'GVL.off': false,
  'GVL.arr[3]': 10n,
  'GVL.arr[1, 2].w': 20n,
  '%QW2': 255n,
};
const value = (text: string) => parseComputed(text)?.evaluate((name) => VALUES[name] ?? null);

/** The table that the evaluator of the runtime fulfils as well (tests/runtime/test_watch_expressions.py). */
const { declaration, cases } = JSON.parse(
  readFileSync(join(import.meta.dirname, '../../../tests/runtime/data/watch_expressions.json'), 'utf8'),
) as { declaration: [string, string, string][]; cases: [string, 'bool' | 'int' | 'real' | null, string | null][] };

describe('watch expressions, as the runtime computes them', () => {
  const declared = new Map(
    declaration.map(([name, type, literal]): [string, Operand] => [
      `PLC_PRG.${name}`,
      type === 'BOOL' ? literal === 'TRUE' : type === 'LREAL' ? Number(literal) : BigInt(literal),
    ]),
  );
  it.each(cases)('%s', (text, kind, expected) => {
    const found = parseComputed(text)?.evaluate((name) => declared.get(name) ?? null) ?? null;
    const kinds = { boolean: 'bool', bigint: 'int', number: 'real' } as const;
    expect(found === null ? null : kinds[typeof found as keyof typeof kinds]).toBe(kind);
    expect(found === null ? null : String(found)).toBe(expected);
  });
});

describe('watch expressions', () => {
  it.each<[string, Operand]>([
    ['PLC_PRG.a + 1', 8n],
    ['PLC_PRG.a - PLC_PRG.b', 9n],
    ['PLC_PRG.a / PLC_PRG.b', -3n], // towards zero, as in IEC 61131-3
    ['PLC_PRG.a MOD PLC_PRG.b', 1n],
    ['2 + 3 * PLC_PRG.a', 23n],
    ['(2 + 3) * PLC_PRG.a', 35n],
    ['-PLC_PRG.a', -7n],
    ['GVL.x * 2', 3],
    ['PLC_PRG.a / 2.0', 3.5],
    ['PLC_PRG.a > 5 AND GVL.on', true],
    ['PLC_PRG.a > 5 AND NOT GVL.on', false],
    ['GVL.on XOR GVL.off', true],
    ['GVL.on OR GVL.off AND GVL.off', true],
    ['PLC_PRG.a = 7', true],
    ['GVL.x <> 1.5', false],
    ['PLC_PRG.a < GVL.x', false],
    ['%QW2 AND 16#0F', 15n],
    ['16#FF XOR 2#1111_0000', 15n],
    ['GVL.arr[3] + GVL.arr[1, 2].w', 30n],
    ['ABS(PLC_PRG.b) + MAX(1, 5, 3) - MIN(2, 1)', 6n],
    ['LIMIT(0, PLC_PRG.a, 5)', 5n],
    ['SQRT(16)', 4],
    ['2 ** 10', 1024],
    ['9007199254740993 + 0 * PLC_PRG.a', 9007199254740993n],
  ])('%s', (text, expected) => {
    expect(value(text)).toBe(expected);
  });
  it.each(['PLC_PRG.a / 0', 'PLC_PRG.a MOD 0', 'GVL.on + 1', 'GVL.nowhere + 1', '-GVL.on'])(
    '%s has no value',
    (text) => {
      expect(value(text)).toBeNull();
    },
  );
  it.each([
    'PLC_PRG.a',
    ' GVL.arr[3] ',
    '%QW2',
    'PLC_PRG.a +',
    '(PLC_PRG.a',
    'PLC_PRG.a b',
    'a := 3',
    'ABS()',
    '3#1 + 1 2',
    '',
  ])('%s is no expression', (text) => {
    expect(parseComputed(text)).toBeNull();
  });
  it('name their variables once', () => {
    expect(parseComputed('GVL.x * GVL.x + PLC_PRG.a')?.operands).toEqual(['GVL.x', 'PLC_PRG.a']);
  });
  it('take values as the controller sends them', () => {
    expect(operandOf(5, { kind: 'int', type: 'INT', size: 2 })).toBe(5n);
    expect(operandOf(5, { kind: 'real', type: 'REAL', size: 4 })).toBe(5);
    expect(operandOf('text', { kind: 'string', type: 'STRING', size: 81 })).toBeNull();
  });
});
