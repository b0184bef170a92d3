/**
 * Networks that are commented out (NET-07). Each of their lines begins with a comment of its own kind, so that the text
 * stays what it was: nothing in them is compiled, and taking the marks away gives the network back byte for byte.
 */
import type { Range } from '@/iec/declaration/model';

const MARK = /^[ \t]*\/\/\|(?: |$)?/;

/** The mark at the beginning of a line, '' where it has none. */
export function markOf(line: string): string {
  return MARK.exec(line)?.[0] ?? '';
}

/** A line commented out. */
export function exclude(line: string): string {
  return line === '' ? '//|' : `//| ${line}`;
}

/** Inverse of `exclude`. */
export function include(line: string): string {
  return line.slice(markOf(line).length);
}

/** A line with white space in the place of what is written in it; a mark stays. */
export function blanked(line: string): string {
  const mark = markOf(line);
  return mark + line.slice(mark.length).replace(/\S/g, ' ');
}

export interface Run extends Range {
  readonly excluded: boolean;
  /** Its text as it is to be read: of the same length, white space in the place of the marks. */
  readonly bare: string;
}

/** A text in pieces that are commented out and those that are not; `lines` are its lines, `isComment` one flag each. */
export function runsOf(text: string, lines: readonly Range[], isComment: (line: Range) => boolean): readonly Run[] {
  const runs: { start: number; end: number; excluded: boolean }[] = [];
  for (const line of lines) {
    const excluded = markOf(text.slice(line.start, line.end)) !== '' && isComment(line);
    const last = runs.at(-1);
    if (last?.excluded === excluded) last.end = line.end;
    else runs.push({ start: line.start, end: line.end, excluded });
  }
  return runs.map((run) => ({ ...run, bare: bareOf(text.slice(run.start, run.end), run.excluded) }));
}

function bareOf(text: string, excluded: boolean): string {
  if (!excluded) return text;
  const bare = (line: string) => {
    const mark = markOf(line);
    return ' '.repeat(mark.length) + line.slice(mark.length);
  };
  return text.split('\n').map(bare).join('\n');
}
