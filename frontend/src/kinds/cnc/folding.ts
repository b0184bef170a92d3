/** What can be folded: sections under comments, subprograms, and ranges of correction, smoothing and loop avoidance. */
import { readBlock, valueOf } from './line';

export interface Fold {
  /** Lines from 0, both included. */
  readonly start: number;
  readonly end: number;
}

/** Lines worth a closer look; a line of plain elements is passed in one go. */
const CANDIDATE = /^[^\S\n]*(?:\(|\/\/)|G0*(?:4[012]|5[012]|6[01])(?![\d.])|\b(?:END_)?SUBPROGRAM\b/i;
const OPENS: Readonly<Record<number, string>> = { 41: 'tool', 42: 'tool', 51: 'corner', 52: 'corner', 61: 'loop' };
const CLOSES: Readonly<Record<number, string>> = { 40: 'tool', 50: 'corner', 60: 'loop' };

export function foldsOf(text: string): Fold[] {
  const lines = text.split('\n');
  const folds: Fold[] = [];
  const open = new Map<string, number>();
  let heading = -2;
  let last = lines.length - 1;
  while (last > 0 && lines[last]!.trim() === '') last--;
  const close = (name: string, end: number) => {
    const start = open.get(name);
    open.delete(name);
    if (start !== undefined && end > start) folds.push({ start, end });
  };
  lines.forEach((line, at) => {
    if (!CANDIDATE.test(line)) return;
    const { tokens, words } = readBlock(line);
    const kinds = new Set(tokens.map(({ kind }) => kind));
    if (words.length === 0 && kinds.has('comment') && !kinds.has('statement')) {
      // Comments one below the other are one heading.
      if (heading !== at - 1) {
        close('section', at - 1);
        open.set('section', at);
      }
      heading = at;
      return;
    }
    if (/\bEND_SUBPROGRAM\b/i.test(line)) close('subprogram', at);
    else if (/\bSUBPROGRAM\b/i.test(line) && kinds.has('statement')) open.set('subprogram', at);
    const code = valueOf(readBlock(line), 'G');
    if (code === undefined) return;
    const closed = CLOSES[code];
    const opened = OPENS[code];
    if (closed !== undefined) close(closed, at);
    if (opened !== undefined && !open.has(opened)) open.set(opened, at);
  });
  close('section', last);
  return folds.sort((a, b) => a.start - b.start);
}
