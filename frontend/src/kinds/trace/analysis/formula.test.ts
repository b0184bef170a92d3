import fc from 'fast-check';
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { computed, FormulaError, parseFormula } from './formula';

/** The tables that bind the evaluator of the server, too (tests/traces/test_formula.py). */
const table = (name: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../../../tests/traces/data/${name}.json`, import.meta.url), 'utf8'));
const CASES = table('formula_cases') as {
  values: [text: string, expected: string][];
  faults: [text: string, fault: string, at: number, word: string][];
  channels: [text: string, names: string[]][];
};
const RANDOM = table('formula_random') as { channels: Record<string, string>; cases: [string, string][] };

/** As Python writes numbers. */
const number = (text: string) => Number(text.replace('inf', 'Infinity'));

const value = (text: string, channels: Record<string, number> = {}) => {
  const formula = parseFormula(text);
  return formula.value(formula.channels.map((name) => channels[name.toLowerCase()]!));
};

const fault = (text: string) => {
  try {
    parseFormula(text);
  } catch (error) {
    if (error instanceof FormulaError) return [error.fault, error.at, error.word];
    throw error;
  }
  return null;
};

describe('a formula', () => {
  it.each(CASES.values)('has the value of the table: %s', (text, expected) => {
    const [found, wanted] = [value(text), Number(expected)];
    if (Number.isFinite(wanted) && wanted !== 0) expect(Math.abs(found / wanted - 1)).toBeLessThanOrEqual(1e-15);
    else expect(found).toBe(wanted);
  });

  it.each(CASES.faults)('says what is wrong and where, as the table: %s', (text, ...expected) => {
    expect(fault(text)).toEqual(expected);
  });

  it.each(CASES.channels)('names channels by path, element and pointer, in any case: %s', (text, names) => {
    expect(parseFormula(text).channels).toEqual(names);
  });

  it('has the values of the random formulas, bit by bit', () => {
    const channels = Object.fromEntries(Object.entries(RANDOM.channels).map(([name, text]) => [name, number(text)]));
    const wrong = RANDOM.cases.filter(([text, expected]) => !Object.is(value(text, channels), number(expected)));
    expect(wrong).toEqual([]);
    expect(RANDOM.cases.length).toBeGreaterThan(500);
  });

  it('has a gap where a channel has one, also where it would not matter', () => {
    expect(value('x * 0', { x: NaN })).toBeNaN();
    expect(value('TRUE OR x', { x: NaN })).toBeNaN();
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
