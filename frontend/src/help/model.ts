/** The pages of the help: which one explains what stands at a place, and which fit a search. Pure functions. */
import type { Schemas } from '@/api/types';

export type HelpEntry = Schemas['HelpEntry'];
export type HelpPage = Schemas['HelpPage'];

export interface HelpTarget {
  kind: HelpEntry['kind'];
  name: string;
}

const SHOWN = 100;
const NAME = /[\p{L}_][\p{L}\p{N}_]*/u;

/** Pages whose words begin with what is looked for come first, then titles, then what they say. */
export function searchEntries(entries: readonly HelpEntry[], text: string): HelpEntry[] {
  const wanted = text.trim().toUpperCase();
  if (wanted === '') return [];
  const rank = (entry: HelpEntry): number => {
    if (entry.words.includes(wanted)) return 0;
    if (entry.words.some((word) => word.startsWith(wanted))) return 1;
    if (entry.title.toUpperCase().includes(wanted)) return 2;
    return entry.summary.toUpperCase().includes(wanted) ? 3 : 4;
  };
  return entries
    .map((entry) => ({ entry, at: rank(entry) }))
    .filter(({ at }) => at < 4)
    .sort((a, b) => a.at - b.at)
    .slice(0, SHOWN)
    .map(({ entry }) => entry);
}

/** The page of a word or sign of the language. */
export function entryOfWord(entries: readonly HelpEntry[], word: string): HelpEntry | undefined {
  const wanted = word.toUpperCase();
  const known = entries.find((entry) => entry.kind === 'word' && entry.words.includes(wanted));
  // Conversions have a page together: INT_TO_REAL, TO_STRING, ANY_TO_INT.
  if (known !== undefined || !/(^|_)TO_/.test(wanted)) return known;
  return entries.find((entry) => entry.kind === 'word' && entry.words.includes('TO_INT'));
}

/** The word, or else the sign, that stands at a column (from 1) of a line. */
export function tokenAt(line: string, column: number, signs: ReadonlySet<string>): string {
  for (const match of line.matchAll(new RegExp(NAME, 'gu'))) {
    if (match.index <= column - 1 && column - 1 <= match.index + match[0].length) return match[0];
  }
  for (const length of [2, 1]) {
    for (const start of [column - 1, column - length]) {
      const sign = line.slice(Math.max(0, start), Math.max(0, start) + length);
      if (signs.has(sign)) return sign;
    }
  }
  return '';
}

/** The page of a panel; the watch lists share theirs. */
export function viewOfPanel(panelId: string): string {
  return panelId.replace(/^watch\d$/, 'watch');
}
