/** The scanner of the editors finds in every text what the compiler's finds. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { SECTIONS } from './grammar';
import { textOf, tokenize } from './lexer';
import texts from './texts.json';

/** Pieces as the compiler names them. */
function pieces(text: string): [string, string][] {
  return tokenize(text).flatMap((token): [string, string][] => {
    const piece = textOf(text, token);
    if (token.kind === 'operator' && /^REF=$/i.test(piece)) {
      return [
        ['word', piece.slice(0, 3)],
        ['sign', '='],
      ];
    }
    const kind = { wstring: 'string', operator: 'sign', other: 'sign' }[token.kind as string] ?? token.kind;
    return [[kind, piece]];
  });
}

describe('texts that the compiler has read', () => {
  it('are enough', () => expect(texts.length).toBeGreaterThan(400));
  it.each(texts.map((row) => [JSON.stringify(row.text), row] as const))('%s', (_, row) =>
    expect(pieces(row.text)).toEqual(row.pieces),
  );
  it('hold every section', () => {
    expect(SECTIONS).toContain('VAR_GENERIC');
  });
});

it('leaves out nothing but white space', () => {
  const piece = fc.constantFrom(
    '/*',
    '*/',
    '(*',
    '*)',
    '//',
    "'",
    '"',
    '$',
    '{',
    '}',
    '\n',
    '\r',
    '\r\n',
    ' ',
    'a',
    '1',
    ';',
  );
  fc.assert(
    fc.property(fc.array(piece, { maxLength: 12 }), (some) => {
      const text = some.join('');
      let at = 0;
      for (const token of tokenize(text)) {
        expect(text.slice(at, token.start).trim()).toBe('');
        at = token.end;
      }
      expect(text.slice(at).trim()).toBe('');
    }),
    { numRuns: 1000, examples: [[['a', '/*', '\n']], [['/*', 'a', '\r']]] },
  );
});

it('is linear in the length of a text', () => {
  for (const piece of ['(*', '{', "'", ' ', '/*', "{attribute 'a", 'x#', "'a\n"]) {
    const text = piece.repeat(20_000);
    expect(tokenize(text).at(-1)?.end ?? text.length).toBeLessThanOrEqual(text.length);
  }
  fc.assert(
    fc.property(fc.string({ unit: 'grapheme' }), (text) => {
      for (const token of tokenize(text)) expect(textOf(text, token).trim()).not.toBe('');
    }),
  );
});
