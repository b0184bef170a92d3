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
