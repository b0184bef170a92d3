import { createElement } from 'react';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import type { TextDocument } from '@/text/documents';
import type { GridColumn, GridEditing } from '@/ui/grid/Grid';
import type { GridCursor } from '@/ui/grid/cursor';
import type { GridSelection } from '@/ui/grid/useGridSelection';
import { setEditorSettings, useEditorSettings } from '@/text/settings';
import { AttributesDialog } from './AttributesDialog';
import type { DeclarationModel } from '@/iec/declaration/model';
import { deleteRows, moveRow } from '@/iec/declaration/structure';
import {
  cellText,
  DRAFT_KEY,
  newDraft,
  nextSorting,
  withCell,
  withDraft,
  type Draft,
  type Sorting,
} from './tableModel';

interface TableActsInput {
  document: TextDocument;
  model: DeclarationModel;
  shown: readonly number[];
  selection: GridSelection;
  draft: Draft | null;
  setDraft: (draft: Draft | null) => void;
  setEditing: (editing: GridEditing | null) => void;
  setSorting: (update: (present: Sorting | null) => Sorting | null) => void;
  locked: boolean;
  columns: readonly GridColumn[];
}

export interface CommittedCell {
  row: number;
  column: string;
  value: string;
  key: 'Enter' | 'Tab' | 'blur';
  backwards: boolean;
}

/** The acts of the declaration table on its text, and why they cannot be done now. */
export function useTableActs(input: TableActsInput) {
  const { document, model, shown, selection, draft, setDraft, setEditing, columns } = input;
  const t = useText();
  const lastType = useEditorSettings((settings) => settings.lastType);
  const rows = [...selection.selected].map((at) => shown[at] ?? DRAFT_KEY).filter((row) => row !== DRAFT_KEY);
  const edit = input.locked ? t('decl.locked') : null;
  const some = edit ?? (rows.length === 0 ? t('decl.selectRows') : null);
  const one = edit ?? (rows.length === 1 ? null : t('decl.selectOneRow'));
  const replace = (text: string) => document.replaceText('declaration', text);
  const columnAt = (id: string) =>
    Math.max(
      0,
      columns.findIndex((column) => column.id === id),
    );

  /** This cell has no field of its own: it is a dialog. */
  const editAttributes = async (index: number, typed: string | undefined) => {
    const row = model.rows[index];
    if (row === undefined) return;
    const value = cellText(model, row, 'attributes');
    // The key that opened the dialog is the beginning of the new text, as in every other cell.
    const text = await openDialog<string>((close) => createElement(AttributesDialog, { value: typed ?? value, close }));
    if (text !== undefined && text !== value) replace(withCell(model.text, index, 'attributes', text));
  };

  const open = (cell: GridEditing): void => {
    const index = shown[cell.row] ?? DRAFT_KEY;
    const column = columns[cell.column]?.id;
    if (edit !== null || column === undefined || column === 'number') return;
    if (index !== DRAFT_KEY && model.rows[index]?.special != null) return;
    if (column === 'attributes') void editAttributes(index, cell.initial);
    else setEditing(cell);
  };

  return {
    reason: { edit, some, one },
    edit: open,
    insert: (before: boolean) => {
      if (edit !== null) return;
      input.setSorting(() => null);
      const row = before && rows.length > 0 ? Math.min(...rows) : null;
      const next = newDraft(model, row, lastType);
      setDraft(next);
      const at = next.before ?? model.rows.length;
      const cell: GridCursor = { row: at, column: columnAt('name') };
      selection.move(cell, 'one');
      setEditing(cell);
    },
    remove: () => {
      if (some === null) replace(deleteRows(model.text, rows));
    },
    move: (direction: -1 | 1) => {
      const row = rows[0];
      if (one !== null || row === undefined) return;
      input.setSorting(() => null);
      const moved = moveRow(model.text, row, direction);
      replace(moved.text);
      selection.move({ row: moved.row, column: selection.cursor?.column ?? 0 }, 'one');
    },
    commit: ({ row, column, value, key, backwards }: CommittedCell) => {
      setEditing(null);
      const at = row === DRAFT_KEY ? (draft?.before ?? model.rows.length) : shown.indexOf(row);
      if (row === DRAFT_KEY && draft !== null) {
        replace(withDraft(model.text, draft, value));
        setDraft(null);
      } else {
        replace(withCell(model.text, row, column, value));
      }
      if (column === 'type' && value.trim() !== '') setEditorSettings({ lastType: value.trim() });
      const next = nextCell(
        columns.findIndex((c) => c.id === column),
        columns.length,
        key,
        backwards,
      );
      if (next === null || at < 0) return;
      const cell = { row: at, column: next };
      selection.move(cell, 'one');
      // A new variable goes straight on to its type, the way it is thought of.
      if (key === 'Tab' || row === DRAFT_KEY) setEditing(row === DRAFT_KEY && key !== 'Tab' ? null : cell);
    },
    cancel: () => {
      setEditing(null);
      setDraft(null);
    },
    sort: (column: string) => input.setSorting((present) => nextSorting(present, column)),
    hint: (at: number, column: string): string | undefined => {
      const row = model.rows[shown[at] ?? DRAFT_KEY];
      if (row === undefined) return undefined;
      if (row.special !== null) return t('decl.specialRow');
      return cellText(model, row, column) || undefined;
    },
  };
}

/** Tab goes on to the next cell; Enter stays. */
function nextCell(column: number, columns: number, key: string, backwards: boolean): number | null {
  if (column < 0 || key === 'blur') return null;
  if (key === 'Enter') return column;
  const next = column + (backwards ? -1 : 1);
  return next >= 1 && next < columns ? next : null;
}
