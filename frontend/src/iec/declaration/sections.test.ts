/** The editors see the header and the sections of a text where the compiler's reader sees them. */
import { describe, expect, it } from 'vitest';
import texts from '../texts.json';
import { parseDeclaration } from './parse';

interface Seen {
  text: string;
  header: [keyword: string, name: string | null, nameStart: number] | null;
  end: number;
  /** The end is null where `END_VAR` is missing. */
  sections: [keyword: string, start: number, end: number | null][];
}
const rows = texts as unknown as readonly Seen[];

describe('texts that the compiler has read', () => {
  it('hold headers and sections', () => {
    expect(rows.filter(({ header }) => header !== null).length).toBeGreaterThan(200);
    expect(rows.filter(({ sections }) => sections.length > 1).length).toBeGreaterThan(100);
  });

  it.each(rows.map((row) => [JSON.stringify(row.text), row] as const))('%s', (_, { text, header, end, sections }) => {
    const { header: head, blocks, problems } = parseDeclaration(text.slice(0, end));
    const open = new Set(problems.filter(({ kind }) => kind === 'missing-end').map(({ start }) => start));
    const seen = blocks
      .filter(({ frame }) => frame === 'variables')
      .map(({ scope, head: { start }, tail }) => [scope, start, open.has(start) ? null : tail.end]);
    expect(seen).toEqual(sections);
    const declares = header !== null && sections[0]?.[0] !== header[0];
    expect(head && [head.keyword.text.toUpperCase(), head.name?.text ?? null]).toEqual(
      declares ? header.slice(0, 2) : null,
    );
  });
});
