import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { attributeLines, setAddress, setAttributes, setComment, setInitial, setName, setType } from './cells';
import { joinComments } from './comments';
import { parseDeclaration } from './parse';
import { deleteRows, insertRow, moveRow, setScope } from './structure';

const PROGRAM = `{attribute 'symbol' := 'readwrite'}
(* the main program *)
PROGRAM PLC_PRG
VAR_INPUT // what comes in
    xStart : BOOL;
END_VAR
VAR_INPUT CONSTANT
    iMax : INT := 10; (* upper bound *)
END_VAR

VAR
    // on-delay
    // of the gate
    {attribute 'hide'}
    fb : TON;
    A, B (* second *), C : INT := 2; // three of them
    arr AT %MW10 : ARRAY [0..3] OF INT := [1, 2(5)]; // samples

    // a remark on its own

    s : STRING(20) := 'a;b := c'; {info 'keep'}
    com : SerialDevice(nPort := 1) := (iBaud := 9600);
END_VAR
`;

const rows = (text: string) =>
  parseDeclaration(text).rows.map((row) => ({
    scope: parseDeclaration(text).blocks[row.block]?.scope,
    name: row.name.text,
    address: row.address?.text ?? '',
    type: row.type?.text ?? '',
    initial: row.initial?.text ?? '',
    comment: joinComments(row.comments.map((cell) => cell.text)),
    attributes: attributeLines(row),
  }));

const names = (text: string) => parseDeclaration(text).rows.map((row) => row.name.text);
const indexOf = (text: string, name: string) => names(text).indexOf(name);

describe('reading a declaration', () => {
  it('finds header, attributes and comment', () => {
    const { header, problems } = parseDeclaration(PROGRAM);
    expect(problems).toEqual([]);
    expect(header?.keyword.text).toBe('PROGRAM');
    expect(header?.name?.text).toBe('PLC_PRG');
    expect(header && attributeLines(header)).toEqual(["attribute 'symbol' := 'readwrite'"]);
    expect(header?.comments.map((cell) => cell.text)).toEqual(['(* the main program *)']);
  });

  it('reads access specifiers as flags, and variables of these names as variables', () => {
    const text =
      'FUNCTION_BLOCK F\nVAR PROTECTED CONSTANT\n  a : INT := 1;\nEND_VAR\nVAR\n  private : INT;\n  public, b : INT;\n  internal AT %MW0 : INT;\nEND_VAR\n';
    const { blocks, problems } = parseDeclaration(text);
    expect(problems).toEqual([]);
    expect(blocks.map((block) => block.flags)).toEqual([['PROTECTED', 'CONSTANT'], []]);
    expect(names(text)).toEqual(['a', 'private', 'public', 'b', 'internal']);
  });

  it('gives one row per variable with every column', () => {
    expect(rows(PROGRAM)).toMatchObject([
      { scope: 'VAR_INPUT', name: 'xStart', type: 'BOOL', comment: '' },
      { scope: 'VAR_INPUT', name: 'iMax', type: 'INT', initial: '10', comment: 'upper bound' },
      { scope: 'VAR', name: 'fb', type: 'TON', comment: 'on-delay\nof the gate', attributes: ["attribute 'hide'"] },
      { name: 'A', type: 'INT', initial: '2', comment: 'three of them' },
      { name: 'B', type: 'INT', initial: '2' },
      { name: 'C', type: 'INT', initial: '2' },
      { name: 'arr', address: '%MW10', type: 'ARRAY [0..3] OF INT', initial: '[1, 2(5)]', comment: 'samples' },
      { name: 's', type: 'STRING(20)', initial: "'a;b := c'", comment: '', attributes: ["info 'keep'"] },
      { name: 'com', type: 'SerialDevice(nPort := 1)', initial: '(iBaud := 9600)' },
    ]);
  });

  it('reads headers of all kinds', () => {
    const header = (text: string) => parseDeclaration(text).header;
    expect(header('FUNCTION_BLOCK ABSTRACT FB_A EXTENDS FB_B IMPLEMENTS I_C, I_D\nVAR\nEND_VAR')).toMatchObject({
      name: { text: 'FB_A' },
      base: { text: 'FB_B' },
    });
    expect(header('METHOD PUBLIC Start : BOOL\nVAR_INPUT\nEND_VAR')).toMatchObject({
      name: { text: 'Start' },
      returnType: { text: 'BOOL' },
    });
    expect(header('PROPERTY Speed : LREAL')).toMatchObject({ name: { text: 'Speed' }, returnType: { text: 'LREAL' } });
    expect(header('VAR_GLOBAL\nEND_VAR')).toBeNull();
  });

  it('reads structures, unions and enumerations', () => {
    const structure =
      'TYPE ST_Axis EXTENDS ST_Base :\nSTRUCT\n    lrPos : LREAL; // mm\n    a, b : BOOL;\nEND_STRUCT\nEND_TYPE\n';
    expect(rows(structure).map((row) => [row.name, row.type, row.comment])).toEqual([
      ['lrPos', 'LREAL', 'mm'],
      ['a', 'BOOL', ''],
      ['b', 'BOOL', ''],
    ]);
    const enumeration = 'TYPE E_Mode : (\n    Off, // at rest\n    On := 5,\n    Auto\n) DINT;\nEND_TYPE\n';
    expect(rows(enumeration).map((row) => [row.name, row.initial, row.comment])).toEqual([
      ['Off', '', 'at rest'],
      ['On', '5', ''],
      ['Auto', '', ''],
    ]);
    expect(parseDeclaration(enumeration).problems).toEqual([]);
    expect(parseDeclaration('TYPE T_Name : STRING(20);\nEND_TYPE').problems[0]?.kind).toBe('not-tabular');
  });

  it('shows instance paths and text pragmas as special rows', () => {
    const text = 'VAR_CONFIG\n    PLC_PRG.fb.xIn AT %IX1.0 : BOOL;\n    {IF defined (X)}\n    {END_IF}\nEND_VAR';
    expect(parseDeclaration(text).rows.map((row) => row.special)).toEqual([
      'PLC_PRG.fb.xIn AT %IX1.0 : BOOL',
      '{IF defined (X)}',
      '{END_IF}',
    ]);
  });

  it.each([
    ['VAR\n  x BOOL;\nEND_VAR', 'missing-colon', 'BOOL'],
    ['VAR\n  x : BOOL\nEND_VAR', 'missing-semicolon', 'BOOL'],
    ['VAR\n  x : ;\nEND_VAR', 'missing-type', ':'],
    ['VAR\n  x : BOOL;\n', 'missing-end', 'VAR'],
    ['VAR\n  7 : BOOL;\nEND_VAR', 'unexpected', '7'],
    ['PROGRAM\nVAR\nEND_VAR', 'missing-name', 'PROGRAM'],
    ['foo bar\nVAR\nEND_VAR', 'unexpected', 'foo'],
  ])('names what is wrong in %j', (text, kind, subject) => {
    expect(parseDeclaration(text).problems).toMatchObject([{ kind, subject }]);
  });

  it('never throws and never leaves the text, whatever is typed', () => {
    const pieces = fc.constantFrom(
      'VAR',
      'VAR_INPUT',
      'END_VAR',
      'PROGRAM',
      'TYPE',
      'STRUCT',
      'END_STRUCT',
      '(',
      ')',
      '[',
      ']',
      ':',
      ':=',
      ';',
      ',',
      'x',
      'AT',
      '%IX0.0',
      'INT',
      '// c\n',
      '(* c',
      '*)',
      '{a}',
      '{',
      "'s",
      '"',
      '\n',
      ' ',
      '.',
      '7',
      'CONSTANT',
      '#',
      '\u4e2d',
    );
    fc.assert(
      fc.property(fc.array(pieces, { maxLength: 40 }), (parts) => {
        const text = parts.join(' ');
        const model = parseDeclaration(text);
        for (const row of model.rows) {
          expect(row.core.start).toBeGreaterThanOrEqual(0);
          expect(row.trail.end).toBeLessThanOrEqual(text.length);
          expect(text.slice(row.name.start, row.name.end)).toBe(row.name.text);
        }
      }),
      { numRuns: 500 },
    );
  });
});

describe('editing a cell', () => {
  it.each([
    ['name', (t: string) => setName(t, indexOf(t, 'iMax'), 'iLimit'), 'iMax', 'iLimit'],
    ['type', (t: string) => setType(t, indexOf(t, 'iMax'), 'DINT'), 'iMax : INT', 'iMax : DINT'],
    ['initial', (t: string) => setInitial(t, indexOf(t, 'iMax'), '11'), ':= 10', ':= 11'],
    [
      'new initial',
      (t: string) => setInitial(t, indexOf(t, 'xStart'), 'TRUE'),
      'xStart : BOOL',
      'xStart : BOOL := TRUE',
    ],
    ['no initial', (t: string) => setInitial(t, indexOf(t, 'arr'), ''), ' := [1, 2(5)]', ''],
    ['address', (t: string) => setAddress(t, indexOf(t, 'arr'), '%MW11'), '%MW10', '%MW11'],
    ['no address', (t: string) => setAddress(t, indexOf(t, 'arr'), ''), ' AT %MW10', ''],
    ['new address', (t: string) => setAddress(t, indexOf(t, 'xStart'), '%IX0.0'), 'xStart', 'xStart AT %IX0.0'],
    ['comment', (t: string) => setComment(t, indexOf(t, 'iMax'), 'limit'), '(* upper bound *)', '(* limit *)'],
    ['new comment', (t: string) => setComment(t, indexOf(t, 'xStart'), 'go'), 'xStart : BOOL;', 'xStart : BOOL; // go'],
    ['no comment', (t: string) => setComment(t, indexOf(t, 'arr'), ''), '; // samples', ';'],
  ])('changes nothing else (%s)', (_what, edit, before, after) => {
    expect(PROGRAM.split(before)).toHaveLength(2);
    expect(edit(PROGRAM)).toBe(PROGRAM.replace(before, after));
  });

  it('writes a comment of several lines above the variable and reads it back', () => {
    const text = setComment(PROGRAM, indexOf(PROGRAM, 'xStart'), 'one\ntwo');
    expect(text).toBe(PROGRAM.replace('    xStart', '    // one\n    // two\n    xStart'));
    expect(rows(text)[0]?.comment).toBe('one\ntwo');
  });

  it('writes attributes in front of the variable (declaration EX-03)', () => {
    const lines = ["attribute 'symbol' := 'read'", "attribute 'monitoring' := 'variable'"];
    const text = setAttributes('VAR\n    x : INT;\nEND_VAR\n', 0, lines);
    expect(text).toBe(
      "VAR\n    {attribute 'symbol' := 'read'}\n    {attribute 'monitoring' := 'variable'}\n    x : INT;\nEND_VAR\n",
    );
    expect(rows(text)[0]?.attributes).toEqual(lines);
    expect(setAttributes(text, 0, [])).toBe('VAR\n    x : INT;\nEND_VAR\n');
  });

  it('gives a variable of a list its own statement when it alone changes', () => {
    const text = setType(PROGRAM, indexOf(PROGRAM, 'B'), 'DINT');
    expect(text).toContain(
      [
        '    A : INT := 2; // three of them',
        '    B (* second *) : DINT := 2; // three of them',
        '    C : INT := 2; // three of them\n',
      ].join('\n'),
    );
    expect(setName(PROGRAM, indexOf(PROGRAM, 'B'), 'BB')).toBe(PROGRAM.replace('B (* second', 'BB (* second'));
  });
});

describe('editing rows', () => {
  it('writes rows as blocks of one scope (declaration EX-04)', () => {
    let text = 'PROGRAM PLC_PRG\n';
    const add = (scope: string, name: string, type: string, more: object = {}) => {
      text = insertRow(text, null, { scope, flags: [], name, type, ...more });
    };
    add('VAR_INPUT', 'xStart', 'BOOL');
    add('VAR_INPUT', 'iMax', 'INT', { flags: ['CONSTANT'], initial: '10' });
    add('VAR', 'fb', 'TON');
    add('VAR', 'arr', 'ARRAY [0..3] OF INT', { initial: '[1, 2(5)]', comment: 'samples' });
    expect(text).toBe(`PROGRAM PLC_PRG
VAR_INPUT
    xStart : BOOL;
END_VAR
VAR_INPUT CONSTANT
    iMax : INT := 10;
END_VAR
VAR
    fb : TON;
    arr : ARRAY [0..3] OF INT := [1, 2(5)]; // samples
END_VAR
`);
  });

  it('inserts before the selected row and splits a block of another scope', () => {
    const text = 'VAR_INPUT\n  a : INT;\n  b : INT;\nEND_VAR\n';
    const local = { scope: 'VAR', flags: [], name: 'x', type: 'BOOL' };
    expect(insertRow(text, 1, { ...local, scope: 'VAR_INPUT' })).toBe(
      'VAR_INPUT\n  a : INT;\n  x : BOOL;\n  b : INT;\nEND_VAR\n',
    );
    expect(insertRow(text, 1, local)).toBe(
      'VAR_INPUT\n  a : INT;\nEND_VAR\nVAR\n    x : BOOL;\nEND_VAR\nVAR_INPUT\n  b : INT;\nEND_VAR\n',
    );
    expect(insertRow(text, 0, local)).toBe('VAR\n    x : BOOL;\nEND_VAR\n' + text);
  });

  it('changes the scope of one row and joins alike blocks again', () => {
    const text = 'VAR\n  a : INT;\n  // of b\n  b : INT;\n  c : INT;\nEND_VAR\n';
    const changed = setScope(text, 1, 'VAR_INPUT', ['CONSTANT']);
    expect(changed).toBe(
      'VAR\n  a : INT;\nEND_VAR\nVAR_INPUT CONSTANT\n  // of b\n  b : INT;\nEND_VAR\nVAR\n  c : INT;\nEND_VAR\n',
    );
    expect(setScope(changed, 1, 'VAR', [])).toBe(text);
  });

  it('moves rows with what belongs to them, over block borders too', () => {
    const text = "VAR_INPUT\n  a : INT; // A\n  b : INT;\nEND_VAR\nVAR\n  {attribute 'x'}\n  c : INT; // C\nEND_VAR\n";
    expect(moveRow(text, 1, -1)).toEqual({
      text: text.replace('  a : INT; // A\n  b : INT;', '  b : INT;\n  a : INT; // A'),
      row: 0,
    });
    const across = moveRow(text, 2, -1);
    expect(across.row).toBe(1);
    expect(across.text).toBe(
      "VAR_INPUT\n  a : INT; // A\nEND_VAR\nVAR\n  {attribute 'x'}\n  c : INT; // C\nEND_VAR\nVAR_INPUT\n  b : INT;\nEND_VAR\n",
    );
    expect(moveRow(across.text, 1, 1).text).toBe(text);
    expect(moveRow(text, 0, -1)).toEqual({ text, row: 0 });
  });

  it('deletes rows and names of a list', () => {
    const gone = deleteRows(PROGRAM, [indexOf(PROGRAM, 'fb'), indexOf(PROGRAM, 'A')]);
    expect(gone).not.toContain('on-delay');
    expect(gone).toContain('    B (* second *), C : INT := 2; // three of them\n');
    expect(gone).toContain('// a remark on its own');
  });

  it('keeps the commas of an enumeration right', () => {
    const text = 'TYPE E : (\n    Off, // o\n    On := 5\n);\nEND_TYPE\n';
    const more = insertRow(text, null, { scope: '', flags: [], name: 'Auto', type: '', comment: 'a' });
    expect(more).toBe('TYPE E : (\n    Off, // o\n    On := 5,\n    Auto // a\n);\nEND_TYPE\n');
    expect(moveRow(more, 2, -1).text).toBe('TYPE E : (\n    Off, // o\n    Auto, // a\n    On := 5\n);\nEND_TYPE\n');
    expect(deleteRows(more, [2])).toBe(text);
    expect(insertRow(text, 0, { scope: '', flags: [], name: 'Nil', type: '' })).toBe(
      'TYPE E : (\n    Nil,\n    Off, // o\n    On := 5\n);\nEND_TYPE\n',
    );
  });
});
