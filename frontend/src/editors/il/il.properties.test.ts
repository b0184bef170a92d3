/** Text and table: whatever a text holds is shown, and what is not touched stays byte for byte. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { copyRows, deleteRows, insertRow, moveRows, negateRows, pasteRows, setCell, toggleNetwork } from './edits';
import { cellText, parseRows, segmentsOf, type IlColumn, type IlRow } from './rows';
import { textOf, tokenize } from '@/iec/lexer';

const COLUMNS: readonly IlColumn[] = ['operator', 'operand', 'comment'];

const name = fc.stringMatching(/^[a-z]{1,4}[0-9]$/);
const operand = fc.oneof(
  name,
  name.map((n) => `${n}.x[3]`),
  fc.constantFrom('TRUE', '16#FF', "'a;(*b'", 'T#1s', '%IX0.1', '-5', 'a1, b2', '(a1, b2)'),
);
const operator = fc.constantFrom('LD', 'LDN', 'ST', 'ANDN', 'ADD', 'JMPC', 'ge', 'SEL', 'x.Run');
const gap = fc.constantFrom(' ', '  ', '\t', '        ');
const words = fc.stringMatching(/^[a-z][a-z:=',{} ]{0,8}[a-z]$/);
const behind = fc.oneof(
  fc.constant(''),
  fc.constant('  '),
  words.map((w) => `   // ${w}`),
  words.map((w) => ` (* ${w} *)`),
);
const indentation = fc.constantFrom('', '    ', '\t', 'm1:  ', 'm2:');
const neat = fc
  .tuple(indentation, operator, gap, operand, behind)
  .map(([lead, op, between, value, trail]) => `${lead}${op}${between}${value}${trail}`);
const other = fc.oneof(
  fc.constantFrom(
    '',
    '   ',
    ')',
    'MUL( 2',
    'CAL t1(',
    '  IN := x,',
    ' Q => y)',
    ')',
    '(* two',
    'lines *)',
    '// c',
    '{p}',
    'm3:',
    '//| LD a',
    '//|',
    '//| m4: LD t2',
  ),
  fc.constantFrom("LD 'open", 'LD (* c *) a', '; ;', 'IF a THEN', 'LD a,', 'b', '&(', '\r', "ST a (* x *) // y'"),
  fc.string({ maxLength: 12 }).map((text) => text.replaceAll('\n', ' ')),
);
const body = fc
  .array(fc.oneof({ weight: 3, arbitrary: neat }, { weight: 2, arbitrary: other }), { maxLength: 8 })
  .map((lines) => lines.join('\n'));

/** A row and where its cells are, for comparing rows of two texts. */
const contents = (row: IlRow) => [row.kind, ...COLUMNS.map((column) => cellText(row, column))].join('|');

/** Whether every string ends in its line. */
const closesStrings = (text: string) =>
  tokenize(text).every((token) => !token.kind.endsWith('string') || /^(['"])[^\n$]*\1$/.test(textOf(text, token)));

describe('IL text and table', () => {
  it('covers every character of the text, and hides none', () => {
    fc.assert(
      fc.property(body, (text) => {
        const rows = parseRows(text);
        let at = 0;
        for (const row of rows) {
          expect(text.slice(at, row.start)).toMatch(/^\n?$/);
          const shown = [row.operator, row.operand, row.comment].flatMap((cell) => cell ?? []);
          // Marks of networks that are commented out show as what they make of the row.
          const bare = row.excluded ? text.replace(/^[ \t]*\/\/\| ?/gm, (mark) => ' '.repeat(mark.length)) : text;
          let rest = bare.slice(row.start, row.end);
          for (const cell of [...shown].reverse()) {
            expect(cell.text).toBe(bare.slice(cell.start, cell.end));
            expect(cell.start).toBeGreaterThanOrEqual(row.start);
            rest = rest.slice(0, cell.start - row.start) + rest.slice(cell.end - row.start);
          }
          expect(rest.trim()).toBe('');
          at = row.end;
        }
        expect(at).toBe(text.length);
      }),
      { numRuns: 500 },
    );
  });

  it('changes nothing when a cell is given the content it has', () => {
    fc.assert(
      fc.property(body, (text) => {
        parseRows(text).forEach((row, index) => {
          for (const column of COLUMNS) expect(setCell(text, index, column, cellText(row, column))).toBe(text);
        });
      }),
    );
  });

  it('changes one cell and leaves every other line as it is', () => {
    fc.assert(
      fc.property(body, fc.nat(20), fc.constantFrom(...COLUMNS), operand, (text, pick, column, value) => {
        const rows = parseRows(text);
        const index = pick % rows.length;
        const row = rows[index]!;
        const changed = setCell(text, index, column, value);
        const tail = text.length - segmentsOf(text).find((line) => line.start === row.lineStart)!.end;
        expect(changed.slice(0, row.start)).toBe(text.slice(0, row.start));
        expect(changed.slice(changed.length - tail)).toBe(text.slice(text.length - tail));
      }),
      { numRuns: 500 },
    );
  });

  it('writes a cell so that it reads back, and keeps the other cells of the row', () => {
    const rows = fc.array(neat, { minLength: 1, maxLength: 5 }).map((lines) => lines.join('\n'));
    fc.assert(
      fc.property(
        rows,
        fc.nat(20),
        fc.constantFrom(...COLUMNS),
        operator,
        operand,
        words,
        (text, pick, column, a, b, c) => {
          const before = parseRows(text);
          const choices = before.flatMap((row, index) => (row.kind === 'instruction' ? [index] : []));
          const index = choices[pick % choices.length]!;
          const value = { operator: a, operand: b, comment: c }[column];
          const after = parseRows(setCell(text, index, column, value));
          expect(after.length).toBe(before.length);
          for (const each of COLUMNS) {
            expect(cellText(after[index]!, each)).toBe(each === column ? value : cellText(before[index]!, each));
          }
          after.forEach((row, at) => {
            if (at !== index) expect(contents(row)).toBe(contents(before[at]!));
          });
        },
      ),
      { numRuns: 500 },
    );
  });

  it('gives the text back when a row is made and deleted, or pasted and deleted', () => {
    fc.assert(
      fc.property(body, body, fc.nat(20), (text, clipboard, pick) => {
        const rows = parseRows(text);
        const index = pick % rows.length;
        // A label that shares its line is moved to a line of its own where a row comes between.
        fc.pre(rows[index + 1]?.lineStart !== rows[index]?.lineStart);
        // Below a comment that does not end, everything is a part of it.
        fc.pre(parseRows(`${text}\n`).length > rows.length);
        // Amid a network that is commented out a new row is, too.
        fc.pre(!rows[index]!.excluded);
        const made = insertRow(text, index);
        const blank = parseRows(made.text)[made.row]!;
        expect(made.text.slice(blank.start, blank.end)).toBe('');
        expect(deleteRows(made.text, [made.row])).toBe(text);
        const row = rows[index]!;
        fc.pre(text !== '' && row.start === row.lineStart);
        const lines = clipboard.replace(/\r\n?/g, '\n').replace(/\n$/, '');
        const pasted = pasteRows(text, index, clipboard);
        expect(pasted.text).toBe(`${text.slice(0, row.start)}${lines}\n${text.slice(row.start)}`);
      }),
      { numRuns: 300 },
    );
  });

  it('copies whole lines as they are written', () => {
    fc.assert(
      fc.property(body, (text) => {
        expect(
          copyRows(
            text,
            parseRows(text).map((_, index) => index),
          ),
        ).toBe(text);
      }),
    );
  });

  it('gives the text back when a network is commented out and in again', () => {
    fc.assert(
      fc.property(body, fc.nat(20), (text, pick) => {
        const rows = parseRows(text);
        const index = pick % rows.length;
        const of = (row: IlRow) => row.network === rows[index]!.network;
        // Next to another one, a network in which a call does not end would go on into that.
        fc.pre(!rows.some(({ excluded }) => excluded));
        const out = toggleNetwork(text, index);
        const now = parseRows(out);
        expect(now.length).toBe(rows.length);
        expect(toggleNetwork(out, index)).toBe(text);
        now.forEach((row, at) => {
          expect(row.network).toBe(rows[at]!.network);
          if (of(row)) expect(row.excluded).toBe(out !== text);
          else expect(contents(row)).toBe(contents(rows[at]!));
        });
      }),
      { numRuns: 500 },
    );
  });

  it('keeps every line when rows are moved, and adds them when they are copied', () => {
    fc.assert(
      fc.property(body, fc.nat(20), fc.nat(20), fc.nat(20), fc.boolean(), (text, from, to, pick, copy) => {
        const rows = parseRows(text);
        const [first, last] = [from % rows.length, to % rows.length].sort((a, b) => a - b) as [number, number];
        const chosen = rows.map((_, index) => index).slice(first, last + 1);
        const before = pick % (rows.length + 1);
        // Whole lines, none into a network that is commented out; examples show what shares a line.
        const begins = (at: number) => rows[at] === undefined || rows[at].start === rows[at].lineStart;
        fc.pre(begins(first) && begins(last + 1) && begins(before) && text !== '');
        fc.pre(closesStrings(text)); // an open one goes on where a later line has a quote
        fc.pre(rows[before]?.excluded !== true && parseRows(`${text}\n`).length > rows.length);
        const moved = moveRows(text, chosen, before, copy);
        const lines = (of: string) => of.split('\n').sort();
        const clipboard = copyRows(text, chosen);
        expect(lines(moved.text)).toEqual(lines(copy ? `${text}\n${clipboard}` : text));
        if (!copy && moved.text === text) return;
        const line = (row: { lineStart: number }) => moved.text.slice(row.lineStart).startsWith(clipboard);
        expect(line(parseRows(moved.text)[moved.row]!)).toBe(true);
      }),
      { numRuns: 500 },
    );
  });

  it('gives the text back when rows are negated twice', () => {
    const rows = fc.array(neat, { minLength: 1, maxLength: 5 }).map((lines) => lines.join('\n'));
    fc.assert(
      fc.property(rows, (text) => {
        const all = parseRows(text).map((_, index) => index);
        const columns = (of: string) => parseRows(of).map(contents);
        expect(columns(negateRows(negateRows(text, all), all))).toEqual(columns(text));
      }),
    );
  });
});
