/** Places of a symbol as rows of a table. Pure. */
import type { ObjectSummary } from '@/api/types';
import { parsePartUri, type Part } from '@/project/partUri';
import type { Access, CrossReference } from '@/lsp/symbols';
import { objectPath } from '@/project/tree';

export const ACCESSES: readonly Access[] = ['declaration', 'read', 'write', 'call', 'address'];

export interface Row {
  key: string;
  symbol: string;
  access: Access;
  objectId: string;
  /** Path of the object in the project. */
  path: string;
  part: Part;
  line: number;
  column: number;
  endColumn: number;
  /** The line around the name, in three pieces. */
  text: readonly [string, string, string];
}

/** Rows in the order of the tree, declarations first; places outside of the project's objects have none. */
export function rowsOf(places: readonly CrossReference[], objects: readonly ObjectSummary[]): Row[] {
  const rows = places.flatMap((place): Row[] => {
    const address = parsePartUri(place.uri);
    if (address === null) return [];
    const { start, end } = place.range;
    return [
      {
        key: `${place.uri}:${String(start.line)}:${String(start.character)}`,
        symbol: place.symbol,
        access: place.access,
        objectId: address.objectId,
        path: objectPath(objects, address.objectId),
        part: address.part,
        line: start.line + 1,
        column: start.character + 1,
        endColumn: end.character + 1,
        text: [
          place.text.slice(0, start.character).trimStart(),
          place.text.slice(start.character, end.character),
          place.text.slice(end.character),
        ],
      },
    ];
  });
  const rank = (row: Row) => (row.access === 'declaration' ? 0 : 1);
  return rows.sort(
    (a, b) =>
      a.symbol.localeCompare(b.symbol) ||
      rank(a) - rank(b) ||
      a.path.localeCompare(b.path) ||
      a.part.localeCompare(b.part) ||
      a.line - b.line ||
      a.column - b.column,
  );
}

/** The rows that a filter leaves: kinds of access that are not hidden, and a text in any column. */
export function filtered(rows: readonly Row[], hidden: ReadonlySet<Access>, text: string): Row[] {
  const wanted = text.trim().toLowerCase();
  return rows.filter(
    (row) =>
      !hidden.has(row.access) &&
      (wanted === '' || `${row.symbol} ${row.path} ${row.text.join('')}`.toLowerCase().includes(wanted)),
  );
}
