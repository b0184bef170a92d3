/** What the table shows in which order, and how a committed cell changes the text. Pure functions. */
import { setAddress, setAttributes, setComment, setInitial, setName, setType } from '@/iec/declaration/cells';
import { joinComments } from '@/iec/declaration/comments';
import type { Block, DeclarationModel, Row } from '@/iec/declaration/model';
import { insertRow, setScope } from '@/iec/declaration/structure';

const COLUMNS = ['number', 'scope', 'name', 'address', 'type', 'initial', 'comment', 'attributes'] as const;
export type ColumnId = (typeof COLUMNS)[number];

export interface Sorting {
  readonly column: string;
  readonly descending: boolean;
}

/** A row that does not exist in the text yet: its name is being typed (DECL-24). */
export interface Draft {
  /** Row it will stand before, null for the end. */
  readonly before: number | null;
  readonly scope: string;
  readonly type: string;
}

/** Stands for the draft in the list of shown rows. */
export const DRAFT_KEY = -1;

/** Columns this kind of declaration has: members have no scope, enumeration values no type. */
export function columnsFor(model: DeclarationModel): readonly ColumnId[] {
  const frame = model.blocks[0]?.frame ?? 'variables';
  if (frame === 'members') return COLUMNS.filter((column) => column !== 'scope' && column !== 'address');
  if (frame === 'enumeration') return ['number', 'name', 'initial', 'comment', 'attributes'];
  return COLUMNS;
}

export function scopeText(block: Block | undefined): string {
  return block === undefined ? '' : [block.scope, ...block.flags].join(' ');
}

/** Text of a cell; for sorting, copying and tooltips. */
export function cellText(model: DeclarationModel, row: Row, column: string): string {
  switch (column) {
    case 'scope':
      return scopeText(model.blocks[row.block]);
    case 'name':
      return row.name.text;
    case 'address':
      return row.address?.text ?? '';
    case 'type':
      return row.type?.text ?? '';
    case 'initial':
      return row.initial?.text ?? '';
    case 'comment':
      return joinComments(row.comments.map((cell) => cell.text));
    case 'attributes':
      return row.attributes.map((cell) => cell.text.slice(1, -1).trim()).join('\n');
    default:
      return '';
  }
}

/** Row numbers in display order: that of the text, or sorted by a column; the draft stands where it will go. */
export function displayOrder(model: DeclarationModel, draft: Draft | null, sorting: Sorting | null): readonly number[] {
  const order = model.rows.map((_, index) => index);
  if (sorting !== null) {
    const factor = sorting.descending ? -1 : 1;
    const key = (index: number) => {
      const row = model.rows[index];
      return row === undefined ? '' : cellText(model, row, sorting.column);
    };
    order.sort((a, b) =>
      sorting.column === 'number'
        ? factor * (a - b)
        : factor * key(a).localeCompare(key(b), undefined, { numeric: true, sensitivity: 'base' }) || a - b,
    );
  }
  if (draft === null) return order;
  const place = draft.before === null ? order.length : order.indexOf(draft.before);
  return [...order.slice(0, place), DRAFT_KEY, ...order.slice(place)];
}

/** A click on a head sorts; further clicks change the direction (DECL-24 .. DECL-34). */
export function nextSorting(present: Sorting | null, column: string): Sorting | null {
  if (column === 'number')
    return present?.column === 'number' && !present.descending ? { column, descending: true } : null;
  return { column, descending: present?.column === column && !present.descending };
}

/** The text after a cell of an existing row was committed. */
export function withCell(text: string, row: number, column: string, value: string): string {
  switch (column) {
    case 'name':
      return setName(text, row, value.trim());
    case 'address':
      return setAddress(text, row, value.trim());
    case 'type':
      return value.trim() === '' ? text : setType(text, row, value.trim());
    case 'initial':
      return setInitial(text, row, value.trim());
    case 'comment':
      return setComment(text, row, value);
    case 'scope': {
      const [scope = 'VAR', ...flags] = value.split(' ');
      return setScope(text, row, scope, flags);
    }
    case 'attributes':
      return setAttributes(
        text,
        row,
        value
          .split('\n')
          .map((line) => line.trim())
          .filter((line) => line !== ''),
      );
    default:
      return text;
  }
}

export function withDraft(text: string, draft: Draft, name: string): string {
  return insertRow(text, draft.before, { scope: draft.scope, flags: [], name: name.trim(), type: draft.type });
}

/** Where a new row goes: before the selected one, or at the end; with the scope every object allows (DECL-24). */
export function newDraft(model: DeclarationModel, before: number | null, type: string): Draft {
  const global = model.header === null && (model.blocks.length === 0 || model.blocks[0]?.scope === 'VAR_GLOBAL');
  const target = before === null ? undefined : model.rows[before];
  const frame = model.blocks[0]?.frame ?? 'variables';
  const scope =
    frame !== 'variables'
      ? ''
      : global
        ? 'VAR_GLOBAL'
        : model.header?.keyword.text.toUpperCase() === 'INTERFACE'
          ? 'VAR_INPUT'
          : 'VAR';
  const first = target === undefined ? before : model.rows.findIndex((row) => row.statement === target.statement);
  return { before: first, scope, type };
}
