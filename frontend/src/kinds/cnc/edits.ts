/** Changes of a program, in whole lines: what a table, a quick fix and an operation make of it. */
import { smallestChange, type TextChange } from '@/iec/declaration/text';
import type { Block, Word } from './line';

/** Lines `from` to `from + removed - 1` become others. */
export interface LinesEdit {
  readonly from: number;
  readonly removed: number;
  readonly lines: readonly string[];
}

/** The text after edits that do not overlap. */
export function appliedTo(lines: readonly string[], edits: readonly LinesEdit[]): string[] {
  const next = [...lines];
  for (const { from, removed, lines: others } of [...edits].sort((a, b) => b.from - a.from))
    next.splice(from, removed, ...others);
  return next;
}

/**
 * Lines in a text that become others, as the smallest change of its characters. The breaks behind them belong to them; at
 * the end of the text, where there is none, the one in front of them (`breakBefore`: places count from there).
 */
export function changeOf(
  before: readonly string[],
  after: readonly string[],
  place: { first: boolean; last: boolean },
): (TextChange & { readonly breakBefore: boolean }) | null {
  const breakBefore = place.last && !place.first;
  const text = (lines: readonly string[]) =>
    place.first && place.last
      ? lines.join('\n')
      : lines.map((line) => (breakBefore ? `\n${line}` : `${line}\n`)).join('');
  const change = smallestChange(text(before), text(after));
  return change && { ...change, breakBefore };
}

export function lineEdit(line: number, text: string): LinesEdit {
  return { from: line, removed: 1, lines: [text] };
}

/** The line with another text in a place. */
export function replaced(text: string, at: number, end: number, by: string): string {
  return text.slice(0, at) + by + text.slice(end);
}

/** The line without a place, and without one of the blanks around it. */
export function cutOut(text: string, at: number, end: number): string {
  const before = text.slice(0, at);
  const behind = text.slice(end);
  if (/\s$/.test(before)) return (behind === '' ? before.trimEnd() : before.slice(0, -1)) + behind;
  return before + (before === '' ? behind.replace(/^\s/, '') : behind);
}

/** Where words stand that a line gets: as programs are written, whatever the order of what is there. */
const ORDER: readonly string[] = [
  ...[
    'N',
    'G',
    'M',
    'X',
    'Y',
    'Z',
    'A',
    'B',
    'C',
    'P',
    'Q',
    'U',
    'V',
    'W',
    'I',
    'J',
    'K',
    'R',
    'T',
    'F',
    'FF',
    'E',
    'EF',
  ],
  ...['D', 'S', 'H', 'L', 'O'],
];

function rank(address: string): number {
  const at = ORDER.indexOf(address);
  return at >= 0 ? at : ORDER.indexOf('EF');
}

/** The line with a further word, behind those that usually stand before it. */
export function withWord(block: Block, address: string, value: string): string {
  const word = address + value;
  const before = block.words.filter((one) => rank(one.address) <= rank(address)).at(-1);
  const { text } = block;
  if (before !== undefined) return `${text.slice(0, before.end)} ${word}${glued(text.slice(before.end))}`;
  const skip = block.tokens.find(({ kind }) => kind === 'skip');
  const first = block.tokens.find(({ kind }) => kind !== 'blank' && kind !== 'skip');
  const at = first?.at ?? skip?.end ?? 0;
  const behind = text.slice(at);
  return text.slice(0, at) + word + (behind.trim() === '' ? behind : ` ${behind}`);
}

/** Words that stood without a blank between them get one. */
function glued(behind: string): string {
  return behind === '' || /^\s/.test(behind) ? behind : ` ${behind}`;
}

/** The line with another value of a word, the word where there is none; without it for null. */
export function withValue(block: Block, word: Word | undefined, address: string, value: string | null): string {
  if (word === undefined) return value === null ? block.text : withWord(block, address, value);
  if (value === null) return cutOut(block.text, word.at, word.end);
  return replaced(block.text, word.valueAt, word.end, value);
}
