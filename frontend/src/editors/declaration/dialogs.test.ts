import { describe, expect, it } from 'vitest';
import { headerValues, setHeader, setListAttributes } from '@/iec/declaration/header';
import { composeInitial, formatInitial, givenValues, initialLines, parseInitial } from '@/iec/declaration/initial';
import { formatArrayType, parseArrayType, shapeOf, type MemberSource } from '@/iec/declaration/types';

describe('header', () => {
  const text = "// old\n{attribute 'a'}\nPROGRAM Main\nVAR\nEND_VAR\n";
  it('is read and written in place', () => {
    const values = headerValues(text)!;
    expect(values).toEqual({ keyword: 'PROGRAM', name: 'Main', comment: 'old', attributes: ["attribute 'a'"] });
    expect(setHeader(text, values)).toBe(text);
    expect(setHeader(text, { ...values, name: 'Prg', comment: 'one\ntwo', attributes: ["attribute 'a'", 'b'] })).toBe(
      "// one\n// two\n{attribute 'a'}\n{b}\nPROGRAM Prg\nVAR\nEND_VAR\n",
    );
    expect(setHeader(text, { ...values, comment: '', attributes: [] })).toBe('PROGRAM Main\nVAR\nEND_VAR\n');
  });
  it('gives a function a return type and takes it away again', () => {
    const values = headerValues(text)!;
    const asFunction = setHeader(text, { ...values, keyword: 'FUNCTION' });
    expect(asFunction).toContain('FUNCTION Main : BOOL\n');
    expect(setHeader(asFunction, { ...headerValues(asFunction)!, keyword: 'FUNCTION_BLOCK' })).toContain(
      'FUNCTION_BLOCK Main\n',
    );
  });
});

describe('attributes of a variable list', () => {
  it('stand before its first block', () => {
    const text = "{attribute 'qualified_only'}\nVAR_GLOBAL\n    x : INT;\nEND_VAR\n";
    expect(setListAttributes(text, [])).toBe('VAR_GLOBAL\n    x : INT;\nEND_VAR\n');
    expect(setListAttributes(text, ["attribute 'qualified_only'", "attribute 'linkalways'"])).toBe(
      "{attribute 'qualified_only'}\n{attribute 'linkalways'}\nVAR_GLOBAL\n    x : INT;\nEND_VAR\n",
    );
  });
});

describe('initial values (DECL-31)', () => {
  const members: MemberSource = (name) =>
    name === 'ST_POINT'
      ? [
          { name: 'x', type: 'LREAL', initial: null },
          { name: 'y', type: 'LREAL', initial: '1.5' },
          { name: 'tags', type: 'ARRAY [0..2] OF INT', initial: null },
        ]
      : null;

  it.each(['5', '(a := 1, b := (c := 2, d := [1, 2(5)]))', "[3(0), (x := 'a,b')]", 'GVL.x + 3', 'F(1, 2)'])(
    'keeps %s',
    (text) => expect(formatInitial(parseInitial(text))).toBe(text),
  );

  it('keeps a broken aggregate as it is', () => expect(formatInitial(parseInitial('(a := ,'))).toBe('(a := ,'));

  it('lists components with their values and composes them again', () => {
    const shape = shapeOf('ST_Point', members);
    const given = givenValues(shape, parseInitial('(X := 2.0, tags := [7, 2(8)])'));
    expect(initialLines(shape, 'p', given).map((l) => [l.path, l.value, l.isDefault])).toEqual([
      ['', null, true],
      ['.x', '2.0', false],
      ['.y', '1.5', true],
      ['.tags', null, true],
      ['.tags[0]', '7', false],
      ['.tags[1]', '8', false],
      ['.tags[2]', '8', false],
    ]);
    expect(composeInitial(shape, given)).toBe('(x := 2.0, tags := [7, 2(8)])');
    const { '.x': _x, '.tags[1]': _one, '.tags[2]': _two, ...rest } = given;
    expect(composeInitial(shape, { ...rest, '.y': '3.0' })).toBe('(y := 3.0, tags := [7])');
    expect(composeInitial(shape, {})).toBe('');
  });

  it('keeps what the type gives to array elements', () => {
    const recipe: MemberSource = (name) =>
      name === 'ST_R' ? [{ name: 'a', type: 'ARRAY [0..3] OF INT', initial: '[1, 2(5)]' }] : null;
    const shape = shapeOf('ST_R', recipe);
    expect(initialLines(shape, 'r', {}).map((l) => l.value)).toEqual([null, null, '1', '5', '5', '0']);
    expect(composeInitial(shape, { '.a[0]': '9' })).toBe('(a := [9, 2(5)])');
    expect(composeInitial(shape, { '.a[3]': '7' })).toBe('(a := [1, 2(5), 7])');
    expect(composeInitial(shape, {})).toBe('');
  });

  it('reads and writes array types', () => {
    expect(parseArrayType('array[0..3,1..n] of ARRAY [1..2] OF BOOL')).toEqual({
      dimensions: [
        { low: '0', high: '3' },
        { low: '1', high: 'n' },
      ],
      element: 'ARRAY [1..2] OF BOOL',
    });
    expect(formatArrayType(parseArrayType('ARRAY[1..3]OF INT') ?? { dimensions: [], element: '' })).toBe(
      'ARRAY [1..3] OF INT',
    );
    expect(parseArrayType('INT')).toBeNull();
  });
});
