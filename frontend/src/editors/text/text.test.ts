import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { identifierProblem, isConversion } from '@/iec/keywords';
import { textOf, tokenize } from '@/iec/lexer';
import { expressionOf, findVariables, indexExpressions, type MonitorScope } from '@/iec/variables';

const kinds = (text: string) => tokenize(text).map((token) => `${token.kind} ${textOf(text, token)}`);

describe('tokens', () => {
  it.each([
    ['a:=b;', ['word a', 'operator :=', 'word b', 'operator ;']],
    ['T#1d2h3m4s5ms', ['number T#1d2h3m4s5ms']],
    ['t#100s12ms;', ['number t#100s12ms', 'operator ;']],
    ['DT#1996-05-06-15:36:30', ['number DT#1996-05-06-15:36:30']],
    ['TOD#15:36:30.123', ['number TOD#15:36:30.123']],
    ['INT#16#FF', ['number INT#16#FF']],
    ['E_Mode#On', ['number E_Mode#On']],
    ['2#1001_0011', ['number 2#1001_0011']],
    ['1.64e+009', ['number 1.64e+009']],
    ['0..3', ['number 0', 'operator ..', 'number 3']],
    ['x.3', ['word x', 'operator .', 'number 3']],
    ["'it$'s' \"w\"", ["string 'it$'s'", 'wstring "w"']],
    ['(* a (* b *) c *) d', ['comment (* a (* b *) c *)', 'word d']],
    ["{attribute 'a}b'} x", ["pragma {attribute 'a}b'}", 'word x']],
    ['%IX7.2 %QW215 %I*', ['address %IX7.2', 'address %QW215', 'address %I*']],
    ['p REF= q', ['word p', 'operator REF=', 'word q']],
    ['xREF=5', ['word xREF', 'operator =', 'number 5']],
    ['\uff1b', ['other \uff1b']],
    ['// c\nx', ['comment // c', 'word x']],
  ])('%s', (text, expected) => expect(kinds(text)).toEqual(expected));

  it('cover any text without overlap or loss', () => {
    fc.assert(
      fc.property(fc.string({ unit: 'binary', maxLength: 60 }), (text) => {
        let at = 0;
        for (const token of tokenize(text)) {
          expect(text.slice(at, token.start).trim()).toBe('');
          expect(token.end).toBeGreaterThan(token.start);
          at = token.end;
        }
        expect(text.slice(at).trim()).toBe('');
      }),
    );
  });
});

describe('names', () => {
  it.each([
    ['iValue', null],
    ['_x', null],
    ['', 'empty'],
    ['1x', 'characters'],
    ['a b', 'characters'],
    ['a__b', 'underscores'],
    ['End_Var', 'reserved'],
    ['INT_TO_REAL', 'reserved'],
  ])('%s', (name, problem) => expect(identifierProblem(name)).toBe(problem));
  it('knows conversions', () => {
    expect(isConversion('to_string')).toBe(true);
    expect(isConversion('GO_TO_HOME')).toBe(false);
  });
});

const scope: MonitorScope = {
  instance: 'PLC_PRG.fb1',
  members: new Set(['X', 'ARR', 'I', 'TON1', 'ST', 'N']),
  temporary: new Set(['TMP']),
};
const values: Record<string, number> = { 'PLC_PRG.fb1.i': 4, 'GVL.k': 2 };
const indexValue = (expression: string) => values[expression] ?? null;

function expressions(text: string): (string | null)[] {
  return findVariables(text).map((use) => expressionOf(use.path, scope, indexValue));
}

describe('variables of a body', () => {
  it.each([
    ['x := gVar + 1;', ['PLC_PRG.fb1.x', 'gVar']],
    ['IF x AND NOT GVL.y THEN tmp := 5; END_IF', ['PLC_PRG.fb1.x', 'GVL.y', null]],
    ['ton1(IN := x, PT := T#5s, Q => n);', ['PLC_PRG.fb1.x', 'PLC_PRG.fb1.n']],
    ['x := (n = 5);', ['PLC_PRG.fb1.x', 'PLC_PRG.fb1.n']],
    ['st.pos[3].q.2 := arr[-1, 2];', ['PLC_PRG.fb1.st.pos[3].q.2', 'PLC_PRG.fb1.arr[-1, 2]']],
    ['arr[i] := arr[i + 1] - arr[GVL.k-1];',
      ['PLC_PRG.fb1.arr[4]', 'PLC_PRG.fb1.i', 'PLC_PRG.fb1.arr[5]', 'PLC_PRG.fb1.i', 'PLC_PRG.fb1.arr[1]', 'GVL.k']],
    ['x := MAX(n, INT_TO_REAL(i));', ['PLC_PRG.fb1.x', 'PLC_PRG.fb1.n', 'PLC_PRG.fb1.i']],
    ['p^.y := x; q := p^;', ['PLC_PRG.fb1.x', 'q']],
    ['THIS^.x := .gVar; SUPER^.Go();', ['PLC_PRG.fb1.x', 'gVar']],
    ['lab: x := 1; JMP lab;', ['PLC_PRG.fb1.x']],
    ['CASE n OF 1: x := 2; END_CASE', ['PLC_PRG.fb1.n', 'PLC_PRG.fb1.x']],
    ['%QX0.1 := %MW3 = 5; // x\n(* n *)', ['%QX0.1', '%MW3']],
    ['arr[f(n)] := 1;', ['PLC_PRG.fb1.n']],
    ["s := 'x := n';", ['s']],
  ])('%s', (text, expected) => expect(expressions(text)).toEqual(expected)); // prettier-ignore

  it('know where the value belongs', () => {
    const text = 'a := arr[ i ].x ;';
    const [first, second, third] = findVariables(text);
    expect(first && text.slice(first.start, first.end)).toBe('a');
    expect(second && text.slice(second.start, second.end)).toBe('arr[ i ].x');
    expect(third && text.slice(third.start, third.end)).toBe('i');
  });

  it('name the index variables that have to be watched', () => {
    const [use] = findVariables('arr[i].b[GVL.k + 1]');
    expect(use && indexExpressions(use.path, scope, indexValue)).toEqual(['PLC_PRG.fb1.i', 'GVL.k']);
    expect(use && expressionOf(use.path, { ...scope, members: null }, () => null)).toBeNull();
  });

  it('end for any text', () => {
    const pieces = fc.constantFrom(
      'x',
      '.',
      '[',
      ']',
      '(',
      ')',
      '^',
      ':=',
      ',',
      ';',
      '3',
      'THIS',
      'JMP',
      '+',
      ':',
      '%IX0.0',
    );
    fc.assert(
      fc.property(fc.array(pieces, { maxLength: 30 }), (parts) => {
        const text = parts.join('');
        for (const use of findVariables(text)) {
          expect(use.end).toBeGreaterThan(use.start);
          expect(use.end).toBeLessThanOrEqual(text.length);
        }
      }),
      { numRuns: 1000 },
    );
  });
});
