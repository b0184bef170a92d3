/** Bookmarks as data: where they stand, how they follow edits, which one is next. Pure functions. */
import type { ObjectSummary } from '@/api/types';
import type { Part } from '@/project/partUri';
import { forestOf, rootsOf, subtree } from '@/project/tree';

/** A marked line of a text of an object; there is one at most a line. */
export interface Bookmark {
  readonly objectId: string;
  readonly part: Part;
  /** From 1. */
  readonly line: number;
  /** What the line holds, by which it is found again in a text that was changed elsewhere. */
  readonly text: string;
}

export type TextPart = Pick<Bookmark, 'objectId' | 'part'>;
export type Spot = Pick<Bookmark, 'objectId' | 'part' | 'line'>;

/** A change of a text in the coordinates before it, as Monaco tells it. */
export interface TextChange {
  readonly range: {
    readonly startLineNumber: number;
    readonly startColumn: number;
    readonly endLineNumber: number;
    readonly endColumn: number;
  };
  readonly text: string;
}

/** The lines of a text as it is now. */
export interface Lines {
  readonly count: number;
  /** From 1. */
  readonly line: (number: number) => string;
}

/** More than anyone can look through; what is stored stays small. */
export const MOST_BOOKMARKS = 1000;

export function keyOf({ objectId, part, line }: Spot): string {
  return `${objectId}/${part}/${String(line)}`;
}

export function isIn(place: TextPart, { objectId, part }: TextPart): boolean {
  return place.objectId === objectId && place.part === part;
}

/** With a bookmark where there was none, without it where there was one. */
export function toggled(bookmarks: readonly Bookmark[], at: Bookmark): readonly Bookmark[] {
  const others = bookmarks.filter((one) => keyOf(one) !== keyOf(at));
  return others.length < bookmarks.length ? others : [...bookmarks, at].slice(-MOST_BOOKMARKS);
}

/** The bookmarks after an edit of a text: they stay with their lines and go with lines that are deleted. */
export function followed(
  bookmarks: readonly Bookmark[],
  of: TextPart,
  changes: readonly TextChange[],
  lines: Lines,
): readonly Bookmark[] {
  const upwards = [...changes].sort((a, b) => b.range.startLineNumber - a.range.startLineNumber);
  return updated(bookmarks, of, lines, (mark) => lineAfter(mark, upwards));
}

/** The bookmarks in a text that was changed where nobody watched: each goes to the nearest line that reads like its own. */
export function relocated(bookmarks: readonly Bookmark[], of: TextPart, lines: Lines): readonly Bookmark[] {
  return updated(bookmarks, of, lines, (mark) => {
    const wanted = mark.text.trim();
    const fits = (line: number) => line >= 1 && line <= lines.count && lines.line(line).trim() === wanted;
    for (let away = 0; wanted !== '' && away < Math.max(mark.line, lines.count); away += 1) {
      if (fits(mark.line - away)) return mark.line - away;
      if (fits(mark.line + away)) return mark.line + away;
    }
    return Math.min(mark.line, lines.count);
  });
}

function updated(
  bookmarks: readonly Bookmark[],
  of: TextPart,
  lines: Lines,
  lineOf: (mark: Bookmark) => number | null,
): readonly Bookmark[] {
  let changed = false;
  const taken = new Set<number>();
  const next = bookmarks.flatMap((mark) => {
    if (!isIn(mark, of)) return [mark];
    const line = lineOf(mark);
    if (line === null || line > lines.count || taken.has(line)) {
      changed = true;
      return [];
    }
    taken.add(line);
    const text = lines.line(line).trimEnd();
    if (line === mark.line && text === mark.text) return [mark];
    changed = true;
    return [{ ...mark, line, text }];
  });
  return changed ? next : bookmarks;
}

function lineAfter({ line: before, text }: Bookmark, upwards: readonly TextChange[]): number | null {
  const firstColumn = text.length - text.trimStart().length + 1;
  let line = before;
  for (const { range, text: inserted } of upwards) {
    const { startLineNumber: start, startColumn, endLineNumber: end, endColumn } = range;
    if (start > before) continue;
    const added = inserted.split('\n').length - 1;
    if (end < before) {
      line += added - (end - start);
      continue;
    }
    const headStays = start === before && startColumn > firstColumn;
    const tailStays = end === before && (endColumn === 1 || endColumn <= text.length);
    if (headStays) continue;
    if (tailStays && text !== '') line += start + added - before;
    else if (start === end && added === 0) continue;
    else {
      const found = lineAmong(inserted, text, before - start);
      if (found !== null) line += start + found - before;
      else if (tailStays) line += start + added - before;
      else return null;
    }
  }
  return line;
}

/** Which line of a text that replaces another one reads like a line; the one nearest to where it was. */
function lineAmong(inserted: string, text: string, near: number): number | null {
  const wanted = text.trim();
  if (wanted === '') return null;
  const fitting = inserted.split('\n').flatMap((line, index) => (line.trim() === wanted ? [index] : []));
  return fitting.sort((a, b) => Math.abs(a - near) - Math.abs(b - near))[0] ?? null;
}

/** The bookmarks of objects that exist, in the order of the tree; declarations come before bodies. */
export function inOrder(bookmarks: readonly Bookmark[], objects: readonly ObjectSummary[]): Bookmark[] {
  const compare = orderOf(objects);
  const known = new Set(objects.map(({ id }) => id));
  return bookmarks.filter(({ objectId }) => known.has(objectId)).sort(compare);
}

function orderOf(objects: readonly ObjectSummary[]): (a: Spot, b: Spot) => number {
  const forest = forestOf(objects);
  const roots = [...rootsOf(forest, 'devices'), ...rootsOf(forest, 'pous')];
  const rank = new Map(roots.flatMap(({ id }) => subtree(forest, id)).map(({ id }, index) => [id, index]));
  return (a, b) =>
    (rank.get(a.objectId) ?? 0) - (rank.get(b.objectId) ?? 0) || a.part.localeCompare(b.part) || a.line - b.line;
}

/** The bookmark that follows a place, or comes before it; behind the last one comes the first. */
export function stepFrom(
  bookmarks: readonly Bookmark[],
  objects: readonly ObjectSummary[],
  from: Spot | null,
  by: 1 | -1,
): Bookmark | undefined {
  const all = inOrder(bookmarks, objects);
  const compare = orderOf(objects);
  const beyond = (mark: Bookmark) => from !== null && compare(mark, from) * by > 0;
  return by > 0 ? (all.find(beyond) ?? all[0]) : (all.findLast(beyond) ?? all.at(-1));
}

/** What was stored, without what is no bookmark. */
export function fromStored(stored: unknown): readonly Bookmark[] {
  return (Array.isArray(stored) ? stored : []).filter(isBookmark).slice(0, MOST_BOOKMARKS);
}

function isBookmark(value: unknown): value is Bookmark {
  const { objectId, part, line, text } = (value ?? {}) as Partial<Record<keyof Bookmark, unknown>>;
  return (
    typeof objectId === 'string' &&
    (part === 'declaration' || part === 'implementation') &&
    Number.isInteger(line) &&
    (line as number) >= 1 &&
    typeof text === 'string'
  );
}
