import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { computed, FormulaError, parseFormula } from './formula';

const value = (text: string, channels: Record<string, number> = {}) => {
  const formula = parseFormula(text);
  return formula.value(formula.channels.map((name) => channels[name]!));
};

const fault = (text: string) => {
  try {
    parseFormula(text);
  } catch (error) {
    if (error instanceof FormulaError) return [error.fault, error.at];
    throw error;
  }
  return null;
};

describe('a formula', () => {
  it('has the precedence of IEC 61131-3', () => {
    expect(value('1 + 2 * 3')).toBe(7);
    expect(value('-2 ** 2')).toBe(4);
    expect(value('2 ** 3 ** 2')).toBe(64);
    expect(value('2 ** -1')).toBe(0.5);
    expect(value('10 - 4 - 3')).toBe(3);
    expect(value('7 MOD 4 * 2')).toBe(6);
    expect(value('TRUE OR FALSE AND FALSE')).toBe(1);
    expect(value('NOT FALSE AND FALSE')).toBe(0);
    expect(value('1 < 2 = (3 > 2)')).toBe(1);
    expect(value('TRUE XOR TRUE OR TRUE')).toBe(1);
    expect(value('16#FF + 2#101 + 1_000 + 1.5e1')).toBe(255 + 5 + 1000 + 15);
  });

  it('names channels by path, element and pointer, in any case', () => {
    const formula = parseFormula('PLC_PRG.a - plc_prg.A + gvl.arr[2].x * p^.y + q^ + arr[i[1], 2]');
    expect(formula.channels).toEqual(['PLC_PRG.a', 'gvl.arr[2].x', 'p^.y', 'q^', 'arr[i[1],2]']);
    expect(formula.value([9, 2, 3, 4, 5])).toBe(15);
  });

  it('has functions', () => {
    expect(value('SQRT(x*x + y*y)', { x: 3, y: 4 })).toBe(5);
    expect(value('LIMIT(0, x, 10) + min(1, 2, -3) + Max(4, 5)', { x: 99 })).toBe(12);
    expect(value('SEL(x > 0, 1, 2)', { x: 1 })).toBe(2);
  });

  it('has a gap where a channel has one, also where it would not matter', () => {
    expect(value('x * 0', { x: NaN })).toBeNaN();
    expect(value('TRUE OR x', { x: NaN })).toBeNaN();
  });

  it('says what is wrong and where', () => {
    expect(fault('')).toEqual(['empty', 0]);
    expect(fault('  ')).toEqual(['empty', 0]);
    expect(fault('1 +')).toEqual(['end', 3]);
    expect(fault('1 + * 2')).toEqual(['unexpected', 4]);
    expect(fault('(a')).toEqual(['end', 2]);
    expect(fault('a b')).toEqual(['unexpected', 2]);
    expect(fault('a ? b')).toEqual(['unexpected', 2]);
    expect(fault('1 + FOO(2)')).toEqual(['function', 4]);
    expect(fault('ABS(1, 2)')).toEqual(['arguments', 0]);
    expect(fault('a AND')).toEqual(['end', 5]);
    expect(fault('('.repeat(5000))?.[0]).toBe('tooDeep');
  });

  it('computes what JavaScript computes for the same tree', () => {
    type Tree = { iec: string; js: string };
    const trees = fc.letrec<{ tree: Tree }>((tie) => ({
      tree: fc.oneof(
        { depthSize: 'small' },
        fc.integer({ min: 0, max: 99 }).map((n): Tree => ({ iec: String(n), js: String(n) })),
        fc.constantFrom('a', 'b').map((name): Tree => ({ iec: name, js: name })),
        fc
          .tuple(tie('tree'), fc.constantFrom('+', '-', '*', '/'), tie('tree'))
          .map(([l, op, r]): Tree => ({ iec: `(${l.iec} ${op} ${r.iec})`, js: `(${l.js} ${op} ${r.js})` })),
        tie('tree').map((of): Tree => ({ iec: `ABS(${of.iec})`, js: `Math.abs(${of.js})` })),
      ),
    })).tree;
    fc.assert(
      fc.property(trees, fc.integer({ min: -9, max: 9 }), fc.integer({ min: -9, max: 9 }), (tree, a, b) => {
        // eslint-disable-next-line @typescript-eslint/no-implied-eval
        const expected = new Function('a', 'b', `return ${tree.js}`) as (a: number, b: number) => number;
        expect(value(tree.iec, { a, b })).toEqual(expected(a, b));
      }),
    );
  });

  it('is computed sample by sample', () => {
    const formula = parseFormula('b - a');
    expect([
      ...computed(
        formula,
        [
          [5, NaN, 7],
          [1, 2, 3],
        ],
        3,
      ),
    ]).toEqual([4, NaN, 4]);
  });
});
