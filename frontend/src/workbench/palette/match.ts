/** Fuzzy search as quick open does it: all letters in their order, word beginnings and runs first. Pure functions. */

export interface Match {
  /** Higher is better. */
  score: number;
  /** Positions in the text that were matched, to be marked. */
  at: readonly number[];
}

const START = 12;
const WORD = 8;
const RUN = 5;
const LETTER = 1;
const GAP = 0.15;

/** Null when the letters of the query do not all occur in this order. Blanks in the query are ignored. */
export function match(query: string, text: string): Match | null {
  const wanted = query.toLowerCase().replace(/\s+/g, '');
  if (wanted === '') return { score: 0, at: [] };
  const whole = text.toLowerCase().indexOf(query.trim().toLowerCase());
  if (whole >= 0) {
    const at = Array.from({ length: query.trim().length }, (_, index) => whole + index);
    return {
      score: wanted.length * RUN + (whole === 0 ? START : isWordStart(text, whole) ? WORD : 0) - text.length * 0.02,
      at,
    };
  }
  return scattered(wanted, text);
}

function scattered(wanted: string, text: string): Match | null {
  const lower = text.toLowerCase();
  const at: number[] = [];
  let score = 0;
  let from = 0;
  for (const letter of wanted) {
    const next = nextPlace(lower, text, letter, from, at.at(-1));
    if (next < 0) return null;
    score += next === 0 ? START : next - 1 === at.at(-1) ? RUN : isWordStart(text, next) ? WORD : LETTER;
    score -= (next - from) * GAP;
    at.push(next);
    from = next + 1;
  }
  return { score: score - text.length * 0.02, at };
}

/** Going on right after the last letter is best, then the beginning of a word, then any place. */
function nextPlace(lower: string, text: string, letter: string, from: number, last: number | undefined): number {
  if (last !== undefined && lower[last + 1] === letter) return last + 1;
  for (let index = lower.indexOf(letter, from); index >= 0; index = lower.indexOf(letter, index + 1)) {
    if (isWordStart(text, index)) return index;
  }
  return lower.indexOf(letter, from);
}

function isWordStart(text: string, index: number): boolean {
  if (index === 0) return true;
  const before = text[index - 1]!;
  const here = text[index]!;
  return /[\s._\-:/]/.test(before) || (/[a-z0-9]/.test(before) && /[A-Z]/.test(here));
}

/** The entries that match, best first; entries equally good keep their order. */
export function search<Entry>(
  query: string,
  entries: readonly Entry[],
  textOf: (entry: Entry) => string,
): { entry: Entry; match: Match }[] {
  const found: { entry: Entry; match: Match }[] = [];
  for (const entry of entries) {
    const result = match(query, textOf(entry));
    if (result) found.push({ entry, match: result });
  }
  return query.trim() === '' ? found : found.sort((a, b) => b.match.score - a.match.score);
}
