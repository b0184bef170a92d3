/** Rows of an online table: roots and, where opened, their components. Pure functions. */
import type { Computed } from './computed/computed';
import { wholeArray, type SymbolChild } from './symbols';

export interface OnlineRoot {
  /** Stable name of the row. */
  readonly key: string;
  /** What is asked of the runtime; empty for a line that is being typed. */
  readonly expression: string;
  /** What the first column shows. */
  readonly label: string;
  readonly type?: string;
  readonly kind?: string;
  readonly leaf?: boolean;
  readonly section?: string;
  readonly flags?: readonly string[];
  readonly address?: string;
  readonly comment?: string;
  /** The line that declares it has a bookmark. */
  readonly bookmarked?: boolean;
  /** There is no value to ask for: a local of a function, an instance that is not chosen. */
  readonly valueless?: boolean;
  /** The value is computed from those of variables. */
  readonly computed?: Computed;
}

export interface OnlineRow extends OnlineRoot {
  readonly depth: number;
  readonly root: number;
  readonly open: boolean | undefined;
}

/** Components by upper-case path, as far as they have been read. */
export type ChildrenByPath = ReadonlyMap<string, readonly SymbolChild[]>;

const COMPOUND = new Set(['array', 'part', 'struct', 'union', 'fb', 'program', 'gvl']);

export function isExpandable(row: {
  readonly kind?: string;
  readonly leaf?: boolean;
  readonly valueless?: boolean;
}): boolean {
  if (row.valueless === true) return false;
  return row.leaf === undefined ? row.kind !== undefined && COMPOUND.has(row.kind) : !row.leaf;
}

/** All rows in order; opened rows whose components are not known yet stand alone. */
export function flatten(
  roots: readonly OnlineRoot[],
  open: ReadonlySet<string>,
  children: ChildrenByPath,
): OnlineRow[] {
  const rows: OnlineRow[] = [];
  const add = (item: OnlineRoot, depth: number, root: number): void => {
    const expandable = isExpandable(item);
    const opened = expandable && open.has(item.key);
    rows.push({ ...item, depth, root, open: expandable ? opened : undefined });
    if (!opened) return;
    for (const child of children.get(item.expression.toUpperCase()) ?? []) add(childOf(item, child), depth + 1, root);
  };
  roots.forEach((root, index) => add(root, 0, index));
  return rows;
}

/** What lies below a row, as a row. */
export function childOf({ key, expression }: Pick<OnlineRoot, 'key' | 'expression'>, child: SymbolChild) {
  const path = wholeArray(expression) + child.path.slice(child.path.length - suffixLength(child));
  return { ...child, key: `${key}/${child.name}`, expression: path, label: child.name };
}

/** `.name` or `[index]` at the end of the child's path. */
function suffixLength(child: SymbolChild): number {
  return child.name.startsWith('[') ? child.name.length : child.name.length + 1;
}

/** Expressions worth asking for: leaves among the rows that are on screen, with some around them. */
export function watchedExpressions(rows: readonly OnlineRow[], first: number, last: number): string[] {
  return rows
    .slice(Math.max(0, first), last + 1)
    .filter((row) => row.valueless !== true && row.expression !== '' && row.leaf !== false)
    .flatMap((row) => row.computed?.operands ?? [row.expression]);
}

/** Whether the row shows a variable that may be written. */
export function isVariable(row: OnlineRow): boolean {
  return row.valueless !== true && row.computed === undefined && !isExpandable(row);
}
