/** The element of an array by the indices that a user types, through the pages of a large array. */
import type { TextKey, TextValues } from '@/i18n';
import { wholeNumber } from './literal';
import type { SymbolChild } from './symbols';
import { childOf, isExpandable, type OnlineRow } from './treeRows';

export type Indices = readonly bigint[];

/** An array or a page of one, as the rows of a table know it. */
export type ArrayRow = Pick<OnlineRow, 'key' | 'expression' | 'label' | 'kind'>;

export type Located =
  /** The rows to open, from the array down, and the row of the element. */
  | { readonly ok: true; readonly opened: readonly string[]; readonly key: string }
  | { readonly ok: false; readonly reason: TextKey; readonly values: TextValues };

const PAGE = /^\[(.+)\.\.(.+)\]$/;

/** The array that a row is, is a page of or stands in; null outside of arrays. */
export function arrayAround(rows: readonly OnlineRow[], at: number): OnlineRow | null {
  let depth = Infinity;
  let page: OnlineRow | null = null;
  for (let index = at; index >= 0; index -= 1) {
    const row = rows[index];
    if (row === undefined || row.depth >= depth) continue;
    depth = row.depth;
    if (isExpandable(row) && row.kind === 'array') return row;
    if (isExpandable(row) && row.kind === 'part') page = row;
    if (depth === 0) break;
  }
  return page;
}

/** Indices by array: `5`, `2, 7`, `[2, 7]`, `[2][7]` of an array of arrays. Null where the text is no such list. */
export function readIndices(text: string): readonly Indices[] | null {
  const plain = text.trim();
  const lists = plain.startsWith('[') ? [...plain.matchAll(/\[([^[\]]*)\]\s*/g)].map((match) => match[1]!) : [plain];
  if (plain.startsWith('[') && plain.replace(/\[[^[\]]*\]\s*/g, '') !== '') return null;
  const numbers = lists.map((list) => list.split(',').map(wholeNumber));
  return numbers.every((list): list is bigint[] => list.every((number) => number !== null)) ? numbers : null;
}

/** First and last element that rows below an array stand for, such as 0, 0 and 9, 3; null where there are none. */
export function extentOf(children: readonly SymbolChild[]): readonly [Indices, Indices] | null {
  const first = children[0] && rangeOf(children[0]);
  const last = children.at(-1) && rangeOf(children.at(-1)!);
  return first && last ? [first[0], last[1]] : null;
}

/** `0..9, 0..3` of a whole array, `2, 1..4, 0` of elements that lie one behind the other. */
export function boundsText([low, high]: readonly [Indices, Indices], page: boolean): string {
  return page
    ? `${low.join(', ')}..${high.join(', ')}`
    : low.map((each, dimension) => `${String(each)}..${String(high[dimension])}`).join(', ');
}

/** Finds an element from the row of an array; `childrenOf` reads what lies below a path. */
export async function locate(
  childrenOf: (path: string) => Promise<readonly SymbolChild[]>,
  array: ArrayRow,
  text: string,
): Promise<Located> {
  const lists = readIndices(text);
  if (lists === null) return { ok: false, reason: 'online.index.noIndices', values: { text: text.trim() } };
  const opened: string[] = [];
  let at = array;
  for (const indices of lists) {
    let children = await childrenOf(at.expression);
    const extent = extentOf(children);
    if (extent === null) return { ok: false, reason: 'online.index.noArray', values: { path: at.expression } };
    const page = at.kind === 'part';
    const bounds = boundsText(extent, page);
    const outside: Located = {
      ok: false,
      reason: 'online.index.outside',
      values: { index: indices.join(', '), bounds },
    };
    if (indices.length !== extent[0].length)
      return { ok: false, reason: 'online.index.dimensions', values: { count: extent[0].length, bounds } };
    if (!(page ? liesBetween : liesInside)(indices, extent)) return outside;
    for (let next = holding(children, indices); ; next = holding(children, indices)) {
      // Between the first and the last element of a page, and no element: an index beyond its own bounds.
      if (next === undefined) return outside;
      opened.push(at.key);
      at = childOf(at, next);
      if (next.kind !== 'part') break;
      children = await childrenOf(at.expression);
    }
  }
  return { ok: true, opened, key: at.key };
}

/** The first and the last element of a row below an array: of an element twice the same. */
function rangeOf({ name }: SymbolChild): readonly [Indices, Indices] | null {
  const page = PAGE.exec(name);
  const low = readIndices(page?.[1] ?? name)?.[0];
  const high = page === null ? low : readIndices(page[2]!)?.[0];
  return low && high ? [low, high] : null;
}

/** The element or the page that an element is in. */
function holding(children: readonly SymbolChild[], indices: Indices): SymbolChild | undefined {
  return children.find((child) => liesBetween(indices, rangeOf(child)));
}

/** Elements follow each other as their indices do, the last one fastest. */
function liesBetween(indices: Indices, range: readonly [Indices, Indices] | null): boolean {
  return range !== null && compare(range[0], indices) <= 0 && compare(indices, range[1]) <= 0;
}

function liesInside(indices: Indices, [low, high]: readonly [Indices, Indices]): boolean {
  return indices.every((index, dimension) => low[dimension]! <= index && index <= high[dimension]!);
}

function compare(a: Indices, b: Indices): number {
  const at = a.findIndex((index, dimension) => index !== b[dimension]);
  return at < 0 ? 0 : a[at]! < b[at]! ? -1 : 1;
}
