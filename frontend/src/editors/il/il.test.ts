/** Rows of IL and what the table does to them. */
import { describe, expect, it } from 'vitest';
import {
  cellProblem,
  copyRows,
  deleteRows,
  insertLabel,
  insertRow,
  moveRows,
  negated,
  negateRows,
  pasteRows,
  setCell,
  toggleNetwork,
} from './edits';
import { cellText, parseRows, rowAt, type IlColumn } from './rows';

/** Rows as `kind|operator|operand|comment`. */
const shown = (text: string) =>
  parseRows(text).map((row) =>
    [row.kind, cellText(row, 'operator'), cellText(row, 'operand'), cellText(row, 'comment')].join('|'),
  );

describe('rows of IL', () => {
  it('puts operator, operand and comment into their columns (IL-01)', () => {
    expect(shown('        LD      TRUE\n        ANDN    bStop   // not now\n        ST      x')).toEqual([
      'instruction|LD|TRUE|',
      'instruction|ANDN|bStop|not now',
      'instruction|ST|x|',
    ]);
  });

  it('shows a label as a row of its own above its instruction (IL-09)', () => {
    expect(shown('LD a\nJMPC mark\nmark:   LD b (* c *)\nalone: // d\nRET')).toEqual([
      'instruction|LD|a|',
      'instruction|JMPC|mark|',
      'label|mark:||',
      'instruction|LD|b|c',
      'label|alone:||d',
      'instruction|RET||',
    ]);
    expect(parseRows('a: LD x\nST y\nb: c: LD z\nST y').map((row) => row.network)).toEqual([1, 1, 1, 2, 2, 2, 2]);
  });

  it('keeps blank lines and comments as rows (IL-10)', () => {
    expect(shown('\n// one\n(* two\n   lines *)\nLD a\n\n')).toEqual([
      'blank|||',
      'comment|||one',
      'comment|||two\nlines',
      'instruction|LD|a|',
      'blank|||',
      'blank|||',
    ]);
    expect(shown('')).toEqual(['blank|||']);
  });

  it('shows further operands without an operator (IL-11)', () => {
    expect(shown('LD a\nADD b,\n    c,\n    d\nST e\nAND a,\nST b')).toEqual([
      'instruction|LD|a|',
      'instruction|ADD|b,|',
      'operand||c,|',
      'operand||d|',
      'instruction|ST|e|',
      'instruction|AND|a,|',
      'instruction|ST|b|',
    ]);
  });

  it('shows what stands in parentheses one level deeper (IL-12)', () => {
    const text = 'LD 2\nMUL( 2\nADD (\nLD 3\n)\n)\nSUB (4)\nGT(a)\nST x';
    expect(shown(text)).toEqual([
      'instruction|LD|2|',
      'instruction|MUL(|2|',
      'instruction|ADD (||',
      'instruction|LD|3|',
      'instruction|)||',
      'instruction|)||',
      'instruction|SUB|(4)|',
      'instruction|GT|(a)|',
      'instruction|ST|x|',
    ]);
    expect(parseRows(text).map((row) => row.depth)).toEqual([0, 0, 1, 2, 1, 0, 0, 0, 0]);
  });

  it('puts functions and methods into the operator column (IL-13, IL-16)', () => {
    expect(
      shown('LD X7\nGeomAverage 25, tvar\nST Ave\nLD TRUE\nIHome.Home TRUE,\nTRUE\nTHIS^.a[1].Go()\nST Z'),
    ).toEqual([
      'instruction|LD|X7|',
      'instruction|GeomAverage|25, tvar|',
      'instruction|ST|Ave|',
      'instruction|LD|TRUE|',
      'instruction|IHome.Home|TRUE,|',
      'operand||TRUE|',
      'instruction|THIS^.a[1].Go|()|',
      'instruction|ST|Z|',
    ]);
  });

  it('shows the parameters of a call by name and value (IL-14, IL-15)', () => {
    const text =
      'CAL POUToCall(\n  Counter := MyCounter,\n  bError => Err\n)\nCAL Inst.Reset()\nCALC t1(IN := x, PT := T#1s)\nST y';
    expect(shown(text)).toEqual([
      'instruction|CAL|POUToCall(|',
      'parameter|Counter :=|MyCounter,|',
      'parameter|bError =>|Err|',
      'operand||)|',
      'instruction|CAL|Inst.Reset()|',
      'instruction|CALC|t1(IN := x, PT := T#1s)|',
      'instruction|ST|y|',
    ]);
    expect(shown('LIMIT(\nMN := 1,\nMX := 5)\nST y').slice(1, 3)).toEqual([
      'parameter|MN :=|1,|',
      'parameter|MX :=|5)|',
    ]);
  });

  it('shows what it cannot divide as it is', () => {
    expect(shown("LD (* a *) b\n{warning disable}\n7 LD\n) ST x\nLD 'open")).toEqual([
      'raw|LD (* a *) b||',
      'raw|{warning disable}||',
      'raw|7 LD||',
      'raw|) ST x||',
      "instruction|LD|'open|",
    ]);
  });

  it('finds the row of a place', () => {
    const rows = parseRows('m: LD a\n\n(* x\ny *)\nST b');
    expect([rowAt(rows, 1), rowAt(rows, 1, 4), rowAt(rows, 2), rowAt(rows, 4), rowAt(rows, 5)]).toEqual([
      0, 1, 2, 3, 4,
    ]);
  });
});

describe('edits of the IL table', () => {
  const set = (text: string, row: number, column: IlColumn, content: string) => setCell(text, row, column, content);

  it('replaces a cell and keeps the columns behind it', () => {
    expect(set('        LD      a       // c', 0, 'operator', 'LDN')).toBe('        LDN     a       // c');
    expect(set('        LD      a       // c', 0, 'operand', 'bLong')).toBe('        LD      bLong   // c');
    expect(set('LD a // c', 0, 'operand', 'bMuchLonger')).toBe('LD bMuchLonger // c');
    expect(set('LD a // c', 0, 'operand', '')).toBe('LD   // c');
    expect(set('LD a', 0, 'operand', '')).toBe('LD');
    expect(set('LD a', 0, 'operator', '')).toBe('   a');
  });

  it('fills empty cells in the columns of the rows around', () => {
    expect(set('\tLD\ta\n', 0, 'comment', 'why')).toBe('\tLD\ta // why\n');
    expect(set('    LD  a\n\n', 1, 'operator', 'ST')).toBe('    LD  a\n    ST\n');
    expect(set('    LD  a\n    ST', 1, 'operand', 'b')).toBe('    LD  a\n    ST  b');
    expect(set('', 0, 'operator', 'LD')).toBe('        LD');
    expect(set('        LD', 0, 'operand', 'a')).toBe('        LD      a');
    expect(set('LD a,', 0, 'comment', '')).toBe('LD a,');
    expect(set('LD a    // x\nST b', 1, 'comment', 'y')).toBe('LD a    // x\nST b    // y');
  });

  it('keeps how a comment is written, and writes several lines in parentheses', () => {
    expect(set('LD a (* x *)', 0, 'comment', 'y')).toBe('LD a (* y *)');
    expect(set('LD a // x', 0, 'comment', 'y *) z')).toBe('LD a // y *) z');
    expect(set('LD a // x', 0, 'comment', 'y\n*) z')).toBe('LD a (* y\n* ) z *)');
    expect(set('LD a // x', 0, 'comment', '')).toBe('LD a');
    expect(set('// x\nLD a', 0, 'comment', 'y')).toBe('// y\nLD a');
  });

  it('changes labels with their colon', () => {
    expect(set('mark:   LD a', 0, 'operator', 'far')).toBe('far:   LD a');
    expect(set('mark:   LD a', 0, 'operator', 'farOff')).toBe('farOff: LD a');
    expect(set('mark:   LD a', 0, 'operator', '')).toBe('        LD a');
    expect(set('mark:   LD a', 0, 'comment', 'no')).toBe('mark:   LD a');
    expect(insertLabel('label1: LD a\nST b', 2)).toEqual({ text: 'label1: LD a\nLabel2:\nST b', row: 2 });
  });

  it('refuses what would swallow the cells behind', () => {
    const row = parseRows('LD a // c')[0]!;
    expect(cellProblem(row, 'operand', "'x")).toBe('open');
    expect(cellProblem(row, 'operand', '"x')).toBe('open');
    expect(cellProblem(row, 'operand', 'a (* b')).toBe('open');
    expect(cellProblem(row, 'operand', 'a (* b *)')).toBe('comment');
    expect(cellProblem(row, 'operator', '// b')).toBe('comment');
    expect(cellProblem(row, 'operand', "'x'")).toBeNull();
    expect(cellProblem(row, 'comment', "don't")).toBeNull();
  });

  it('makes a new row below the present one (IL-05)', () => {
    expect(insertRow('LD a\nST b', 0)).toEqual({ text: 'LD a\n\nST b', row: 1 });
    expect(insertRow('LD a\nST b\n', 2)).toEqual({ text: 'LD a\nST b\n\n', row: 3 });
    expect(insertRow('LD a', null)).toEqual({ text: 'LD a\n', row: 1 });
    expect(insertRow('m: LD a', 0)).toEqual({ text: 'm:\n\n   LD a', row: 1 });
  });

  it('deletes rows (IL-06)', () => {
    expect(deleteRows('LD a\nST b\n', [0])).toBe('ST b\n');
    expect(deleteRows('LD a\nST b', [1])).toBe('LD a');
    expect(deleteRows('LD a\n', [0])).toBe('');
    expect(deleteRows('m: LD a // c\nST b', [1])).toBe('m:\nST b');
    expect(deleteRows('m: LD a // c\nST b', [0])).toBe('   LD a // c\nST b');
    expect(deleteRows('m: LD a // c\nST b', [0, 1])).toBe('ST b');
    expect(deleteRows('LD a\n\nST b', [1])).toBe('LD a\nST b');
  });

  it('copies rows as text and pastes them before a row or at the end (IL-07)', () => {
    const text = '  LD a // c\nm: ST b\n';
    expect(copyRows(text, [0])).toBe('  LD a // c');
    expect(copyRows(text, [0, 1])).toBe('  LD a // c\nm:');
    expect(copyRows(text, [2])).toBe('   ST b');
    expect(copyRows(text, [1, 2])).toBe('m: ST b');
    expect(pasteRows(text, 0, 'LD x\r\nST y\r\n')).toEqual({ text: `LD x\nST y\n${text}`, row: 0, count: 2 });
    expect(pasteRows(text, null, 'LD x')).toEqual({ text: `${text}LD x\n`, row: 3, count: 1 });
    expect(pasteRows('LD a', null, 'LD x').text).toBe('LD a\nLD x');
    expect(pasteRows(text, 2, 'LD x').text).toBe('  LD a // c\nm:\nLD x\n   ST b\n');
    expect(pasteRows('', null, 'LD x')).toEqual({ text: 'LD x', row: 0, count: 1 });
  });
});

describe('rows that are moved', () => {
  const text = 'LD a\nST b\nm: LD c\nST d\n';
  const move = (...args: Parameters<typeof moveRows>) => moveRows(...args);

  it('go in front of a row, within their network or into another one', () => {
    expect(move(text, [0], 2, false)).toEqual({ text: 'ST b\nLD a\nm: LD c\nST d\n', row: 1, count: 1 });
    expect(move(text, [4], 0, false)).toEqual({ text: 'ST d\nLD a\nST b\nm: LD c\n', row: 0, count: 1 });
    expect(move(text, [0, 1], 4, false)).toEqual({ text: 'm: LD c\nLD a\nST b\nST d\n', row: 2, count: 2 });
    expect(move(text, [0, 4], 1, false).text).toBe('LD a\nST d\nST b\nm: LD c\n');
  });

  it('go to the end, where a blank row stays the last one', () => {
    expect(move(text, [0], 6, false)).toEqual({ text: 'ST b\nm: LD c\nST d\nLD a\n', row: 4, count: 1 });
    expect(move('LD a\nST b', [0], 2, false).text).toBe('ST b\nLD a');
    expect(move('LD a\nST b\n', [2], 0, false).text).toBe('\nLD a\nST b');
  });

  it('are copied', () => {
    expect(move(text, [0], 4, true)).toEqual({ text: 'LD a\nST b\nm: LD c\nLD a\nST d\n', row: 4, count: 1 });
    expect(move(text, [0], 0, true).text).toBe(`LD a\n${text}`);
  });

  it('leave a label where it is, or go without their instruction', () => {
    expect(move(text, [3], 0, false).text).toBe('   LD c\nLD a\nST b\nm:\nST d\n');
    expect(move(text, [2], 0, false).text).toBe('m:\nLD a\nST b\n   LD c\nST d\n');
    expect(move(text, [0], 3, false).text).toBe('ST b\nm:\nLD a\n   LD c\nST d\n');
  });

  it('stay where they are when they are dropped on themselves', () => {
    for (const before of [1, 2, 3]) expect(move(text, [1, 2], before, false).text).toBe(text);
    expect(move(text, [], 0, false).text).toBe(text);
  });
});

describe('negation', () => {
  it('is where the language has it (IL-20 to IL-23)', () => {
    const pairs = ['LD LDN', 'st stn', 'AND ANDN', 'Or OrN', 'XOR( XORN(', 'AND ( ANDN (', 'JMPC JMPCN'];
    for (const pair of [...pairs, 'CALC CALCN', 'RETC RETCN']) {
      const [plain = '', not = ''] = pair.split(/ (?=\S*N(?: \(|\(|$))| (?=stn)/i);
      expect([plain, negated(plain)]).toEqual([plain, not]);
      expect([not, negated(not)]).toEqual([not, plain]);
    }
    expect(negated('&')).toBe('ANDN');
    expect(negated('JMPN')).toBe('JMPC');
    for (const word of ['JMP', 'CAL', 'RET', 'S', 'R', 'NOT', 'ADD', 'ADD(', ')', 'MAX', 'x.Run', 'IN :=', ''])
      expect([word, negated(word)]).toEqual([word, null]);
  });

  it('is put into the rows that can have it, and the columns stay', () => {
    const text = '  LD    a // c\n  ADD   b\nm: ANDN  d\n//| LD x\n  CAL t(\n  LD := 1)';
    const all = parseRows(text).map((_, index) => index);
    const not = '  LDN   a // c\n  ADD   b\nm: AND   d\n//| LD x\n  CAL t(\n  LD := 1)';
    expect(negateRows(text, all)).toBe(not);
    expect(negateRows(not, all)).toBe(text);
  });
});

describe('networks that are commented out (NET-07)', () => {
  const text = 'LD a\nST b\n\nm: LD c // why\nST d\nn:\nRET';
  const out = 'LD a\nST b\n\n//| m: LD c // why\n//| ST d\nn:\nRET';

  it('keep their text behind a mark in each line', () => {
    expect(toggleNetwork(text, 5)).toBe(out);
    expect(toggleNetwork(out, 3)).toBe(text);
    expect(toggleNetwork(text, 0)).toBe('//| LD a\n//| ST b\n//|\nm: LD c // why\nST d\nn:\nRET');
    expect(toggleNetwork('\n\n', 0)).toBe('\n\n');
  });

  it('are shown in their columns, with the numbers that the networks had', () => {
    expect(shown(out)).toEqual(shown(text));
    const rows = parseRows(out);
    expect(rows.map(({ excluded }) => excluded)).toEqual([false, false, false, true, true, true, false, false]);
    expect(rows.map(({ network }) => network)).toEqual([1, 1, 1, 2, 2, 2, 3, 3]);
    expect(rows[4]?.operand).toEqual({ start: out.indexOf('c //'), end: out.indexOf('c //') + 1, text: 'c' });
  });

  it('do not change how the others are read', () => {
    const opened = 'CAL t(\n//| LD (* x\nIN := a)\nST b';
    expect(shown(opened)).toEqual([
      'instruction|CAL|t(|',
      'instruction|LD||x',
      'parameter|IN :=|a)|',
      'instruction|ST|b|',
    ]);
    expect(parseRows('(* x\n//| LD a\n*)').map(({ kind, excluded }) => [kind, excluded])).toEqual([['comment', false]]);
  });

  it('are not edited, but deleted, copied and pasted into', () => {
    expect(setCell(out, 4, 'operand', 'x')).toBe(out);
    expect(deleteRows(out, [3])).toBe(out.replace('//| m: LD', '//|    LD'));
    expect(copyRows(out, [3])).toBe('//| m:');
    expect(copyRows(out, [4])).toBe('//|    LD c // why');
    expect(pasteRows(out, 5, 'LD x\n').text).toBe(out.replace('//| ST d', '//| LD x\n//| ST d'));
    expect(moveRows(out, [0], 5, false).text).toBe('ST b\n\n//| m: LD c // why\n//| LD a\n//| ST d\nn:\nRET');
    expect(moveRows(out, [5], 0, false).text).toBe('//| ST d\nLD a\nST b\n\n//| m: LD c // why\nn:\nRET');
  });

  it('keep lines that the text editor has indented or trimmed', () => {
    expect(toggleNetwork('  //| LD a\n  //|\n  //|   ST b', 0)).toBe('LD a\n\n  ST b');
  });
});
