/** Whatever is edited in the table, the rest of the text stays as it was, byte for byte. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { attributeLines, setAddress, setAttributes, setComment, setInitial, setName, setType } from './cells';
import { joinComments } from './comments';
import { parseDeclaration } from './parse';
import { deleteRows, insertRow, moveRow, setScope } from './structure';
import { smallestChange } from './text';

const names = (text: string) => parseDeclaration(text).rows.map((row) => row.name.text);
const commentsOf = (text: string, index: number) =>
  joinComments((parseDeclaration(text).rows[index]?.comments ?? []).map((cell) => cell.text));

const name = fc.stringMatching(/^[a-z][A-Za-z0-9]{0,6}[0-9]$/);
const commentWords = fc.stringMatching(/^[a-z:=;,'{} ]{0,10}[a-z]$/);
const trivia = fc.oneof(
  commentWords.map((words) => `// ${words}\n`),
  commentWords.map((words) => `(* ${words} *)`),
  fc.constant("{attribute 'x' := 'y'}\n"),
  fc.constant('\n\n'),
);
const behind = fc.oneof(
  fc.constant(''),
  fc.constant(' '),
  commentWords.map((words) => ` // ${words}`),
);
const type = fc.constantFrom(
  'INT',
  'BOOL',
  'STRING(20)',
  'ARRAY [0..3, 1..2] OF LREAL',
  'FB_X(a := 1)',
  'POINTER TO BYTE',
);
const initial = fc.constantFrom('', ' := 7', " := 'a;(*b'", ' := [1, 2(5)]', ':=(x := 1, y := (z := 2))');
const address = fc.constantFrom('', '', ' AT %MW4', ' at %I*');
const statement = fc
  .tuple(
    fc.array(trivia, { maxLength: 2 }),
    fc.array(name, { minLength: 1, maxLength: 3 }),
    address,
    type,
    initial,
    behind,
  )
  .map(
    ([lead, list, at, of, value, trail]) =>
      `${lead.join('    ')}    ${list.join(', ')}${at} : ${of}${value};${trail}\n`,
  );
const block = fc
  .tuple(
    fc.constantFrom('VAR', 'VAR_INPUT', 'VAR CONSTANT', 'VAR_OUTPUT RETAIN'),
    fc.array(statement, { maxLength: 4 }),
  )
  .map(([head, statements]) => `${head}\n${statements.join('')}END_VAR\n`);
const declaration = fc
  .array(block, { minLength: 1, maxLength: 4 })
  .map((blocks) => `// file\nFUNCTION_BLOCK FB_Any\n${blocks.join('')}`);

/** Everything in a text that carries meaning or a remark, in order. */
const tokensOf = (text: string) =>
  text
    .split(/(\/\/[^\n]*|\(\*[\s\S]*?\*\)|\{[^}]*\}|'[^']*'|[A-Za-z_]\w*|\d+|:=|\.\.|\S)/)
    .map((piece) => piece.trim())
    .filter((piece) => piece !== '' && !/^(END_)?VAR(_INPUT|_OUTPUT|_TEMP)?$|^CONSTANT$|^RETAIN$/.test(piece))
    .sort();

const withRow = fc.tuple(declaration, fc.nat()).filter(([text]) => parseDeclaration(text).rows.length > 0);

describe('properties of the table', () => {
  it('reads every generated declaration without a problem', () => {
    fc.assert(
      fc.property(declaration, (text) => {
        expect(parseDeclaration(text).problems).toEqual([]);
      }),
    );
  });

  it('a cell edit and back leaves every byte as it was', () => {
    fc.assert(
      fc.property(withRow, ([text, pick]) => {
        const model = parseDeclaration(text);
        const index = pick % model.rows.length;
        const row = model.rows[index]!;
        expect(setName(setName(text, index, 'other9'), index, row.name.text)).toBe(text);
        if (row.shared > 1) return;
        const oldType = row.type!.text;
        expect(setType(setType(text, index, 'LINT'), index, oldType)).toBe(text);
        const value = row.initial?.text ?? '';
        const back = setInitial(setInitial(text, index, '99'), index, value);
        expect(back).toBe(text);
        const place = row.address?.text ?? '';
        expect(setAddress(setAddress(text, index, '%MD8'), index, place)).toBe(text);
        expect(setComment(text, index, joinComments(row.comments.map((c) => c.text)))).toBe(text);
        expect(setAttributes(text, index, attributeLines(row))).toBe(text);
      }),
    );
  });

  it('a cell edit changes only bytes inside the statement', () => {
    fc.assert(
      fc.property(withRow, commentWords, ([text, pick], words) => {
        const model = parseDeclaration(text);
        const index = pick % model.rows.length;
        const row = model.rows[index]!;
        const end = Math.max(row.trail.end, row.separator!.end);
        for (const after of [
          setType(text, index, 'LWORD'),
          setInitial(text, index, '5'),
          setComment(text, index, words),
        ]) {
          expect(after.startsWith(text.slice(0, row.core.start))).toBe(true);
          expect(after.endsWith(text.slice(end))).toBe(true);
          expect(parseDeclaration(after).problems).toEqual([]);
        }
        expect(commentsOf(setComment(text, index, words), index).trim()).toBe(words.trim());
      }),
    );
  });

  it('moving and rescoping loses no token, comment or pragma', () => {
    const act = fc.oneof(
      fc.record({ kind: fc.constant('up' as const), at: fc.nat() }),
      fc.record({ kind: fc.constant('down' as const), at: fc.nat() }),
      fc.record({ kind: fc.constant('scope' as const), at: fc.nat() }),
    );
    fc.assert(
      fc.property(declaration, fc.array(act, { maxLength: 6 }), (text, acts) => {
        let now = text;
        for (const { kind, at } of acts) {
          const count = parseDeclaration(now).rows.length;
          if (count === 0) return;
          const index = at % count;
          const before = names(now);
          if (kind === 'scope') now = setScope(now, index, 'VAR_TEMP', []);
          else {
            const moved = moveRow(now, index, kind === 'up' ? -1 : 1);
            if (moved.text !== now) expect(names(moved.text)[moved.row]).toBe(before[index]);
            now = moved.text;
          }
          expect(parseDeclaration(now).problems).toEqual([]);
          expect([...names(now)].sort()).toEqual([...before].sort());
        }
        expect(tokensOf(now)).toEqual(tokensOf(text));
      }),
      { numRuns: 300 },
    );
  });

  it('inserting and deleting the same row gives the text back', () => {
    fc.assert(
      fc.property(withRow, ([text, pick]) => {
        const model = parseDeclaration(text);
        const index = pick % model.rows.length;
        const row = model.rows[index]!;
        if (model.rows.findIndex((r) => r.statement === row.statement) !== index) return;
        const own = model.blocks[row.block]!;
        const added = insertRow(text, index, { scope: own.scope, flags: own.flags, name: 'added1', type: 'BOOL' });
        expect(names(added)[index]).toBe('added1');
        expect(deleteRows(added, [index])).toBe(text);
      }),
    );
  });
});

describe('smallest change', () => {
  it('turns one text into the other', () => {
    fc.assert(
      fc.property(fc.string(), fc.string(), (before, after) => {
        const change = smallestChange(before, after);
        const result = change ? before.slice(0, change.start) + change.text + before.slice(change.end) : before;
        expect(result).toBe(after);
      }),
    );
  });
});
