import { describe, expect, it } from 'vitest';
import { entryOfWord, searchEntries, tokenAt, viewOfPanel, type HelpEntry } from './model';

const entry = (kind: HelpEntry['kind'], name: string, words: string[], summary = ''): HelpEntry => ({
  kind,
  name,
  title: name,
  summary,
  words,
  library: null,
});
const ENTRIES = [
  entry('message', 'E0204', ['E0204'], 'Identifier not defined; IF it is misspelt'),
  entry('word', 'IF', ['IF', 'END_IF']),
  entry('word', 'TO_INT', ['TO_INT']),
  entry('library', 'TON', ['TON'], 'Standard'),
];

describe('help', () => {
  it('finds words before what is said about others', () => {
    expect(searchEntries(ENTRIES, 'if').map(({ name }) => name)).toEqual(['IF', 'E0204']);
    expect(searchEntries(ENTRIES, 'e02').map(({ name }) => name)).toEqual(['E0204']);
    expect(searchEntries(ENTRIES, ' ')).toEqual([]);
  });

  it('explains words in any case, their ends, and all conversions', () => {
    expect(entryOfWord(ENTRIES, 'end_if')?.name).toBe('IF');
    expect(entryOfWord(ENTRIES, 'WORD_TO_REAL')?.name).toBe('TO_INT');
    expect(entryOfWord(ENTRIES, 'nTotal')).toBeUndefined();
    expect(entryOfWord(ENTRIES, 'TON')).toBeUndefined();
  });

  it('takes the word or sign at the cursor', () => {
    const signs = new Set([':=', '<', '<=', ';']);
    const line = 'nTotal := a <= b;';
    expect(tokenAt(line, 3, signs)).toBe('nTotal');
    expect(tokenAt(line, 7, signs)).toBe('nTotal');
    expect(tokenAt(line, 9, signs)).toBe(':=');
    expect(tokenAt('a <= b', 4, signs)).toBe('<=');
    expect(tokenAt(line, 17, signs)).toBe('b');
    expect(tokenAt('   ', 2, signs)).toBe('');
  });

  it('has one page for all watch lists', () => {
    expect(viewOfPanel('watch3')).toBe('watch');
    expect(viewOfPanel('messages')).toBe('messages');
  });
});
