import { createElement, type RefObject } from 'react';
import type { ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { goToDefinition } from '@/lsp/definition';
import { openDialog } from '@/ui/dialogs';
import { notify } from '@/ui/notices';
import { useSession } from '@/session/session';
import { atLeast } from '@/workbench/rights';
import { InputAssistant } from '../assistant/InputAssistant';
import type { TextDocument } from '@/text/documents';
import type { CellInputHandle } from '@/ui/grid/CellInput';
import type { GridEditing } from '@/ui/grid/Grid';
import type { GridSelection } from '@/ui/grid/useGridSelection';
import type { TextPlace } from '@/text/focus';
import { askToEdit } from '../text/onlineEdit';
import { editedColumn, type ColumnId } from './columns';
import {
  copyRows,
  deleteRows,
  insertLabel,
  insertRow,
  moveRows,
  negatedOf,
  negateRows,
  pasteRows,
  setCell,
  toggleNetwork,
} from './edits';
import type { EndedBy } from './IlCellEditor';
import { cellText, parseRows, type IlColumn, type IlRow } from './rows';

/** The cell being edited, with the column of the text it stands for. */
export interface IlEditing extends GridEditing {
  readonly of: IlColumn;
}

interface ActsInput {
  projectId: string;
  object: ObjectSummary;
  document: TextDocument;
  rows: readonly IlRow[];
  columns: readonly { readonly id: ColumnId }[];
  selection: GridSelection;
  locked: boolean;
  editing: IlEditing | null;
  setEditing: (editing: IlEditing | null) => void;
  openCell: RefObject<CellInputHandle | null>;
  place: TextPlace;
  focus: () => void;
}

/** The acts of the IL table on its text. */
export function useIlActs(input: ActsInput) {
  const { document, rows, columns, selection, editing, setEditing } = input;
  const chosen = [...selection.selected].sort((a, b) => a - b);
  const model = document.models.implementation;
  const columnAt = (id: ColumnId) =>
    Math.max(
      0,
      columns.findIndex((column) => column.id === id),
    );

  /** Runs a change of the text, once the user has agreed that it is edited while logged in. */
  const change = (run: () => void): void => {
    if (!input.locked) run();
    else if (!atLeast(useSession.getState().user?.role ?? null, 'engineer'))
      notify({ tone: 'info', title: t('st.lockedRole') });
    else void askToEdit(input.object.id).then((yes) => yes && run());
  };
  const replace = (text: string) => document.replaceText('implementation', text);
  const select = (row: number, column: ColumnId, last = row) => {
    selection.move({ row, column: columnAt(column) }, 'one');
    if (last > row) selection.move({ row: last, column: columnAt(column) }, 'range');
  };

  const edit = (cell: GridEditing): void => {
    const row = rows[cell.row];
    const column = row && editedColumn(row, columns[cell.column]?.id);
    if (row?.excluded === true) notify({ tone: 'info', title: t('il.excludedRow') });
    if (row === undefined || column == null) return;
    change(() => {
      // In a row without an instruction, the first thing written is its operator.
      const of = column === 'operand' && row.kind === 'blank' && !takesOperand(cell.row) ? 'operator' : column;
      const shown = row.kind === 'comment' ? 'operator' : of;
      setEditing({ ...cell, column: columnAt(shown), of });
    });
  };
  const takesOperand = (row: number) => {
    const tried = parseRows(setCell(model.getValue(), row, 'operand', 'x'))[row];
    return tried?.operand?.text === 'x';
  };
  const editAfter = (text: string, row: number, of: IlColumn) => {
    replace(text);
    const column = columnAt(of);
    selection.move({ row, column }, 'one');
    setEditing({ row, column, of });
  };
  const newRow = (text = model.getValue()) => {
    const made = insertRow(text, selection.cursor?.row ?? null);
    editAfter(made.text, made.row, 'operator');
  };

  const commit = (content: string, by: EndedBy): void => {
    if (editing === null) return;
    setEditing(null);
    const text = setCell(model.getValue(), editing.row, editing.of, content);
    if (by === 'NewRow') {
      newRow(text);
      return;
    }
    replace(text);
    if (by !== 'Tab' && by !== 'BackTab') return;
    const row = parseRows(text)[editing.row];
    const at = editing.column + (by === 'Tab' ? 1 : -1);
    const step = by === 'Tab' ? 1 : -1;
    for (let next = at; row !== undefined && columns[next] !== undefined; next += step) {
      const of = editedColumn(row, columns[next]?.id);
      if (of === null || columns[next]?.id !== of) continue;
      selection.move({ row: editing.row, column: next }, 'one');
      setEditing({ row: editing.row, column: next, of });
      return;
    }
  };

  const remove = () => {
    if (chosen.length === 0) return;
    change(() => {
      const text = deleteRows(model.getValue(), chosen);
      replace(text);
      const row = Math.min(chosen[0] ?? 0, parseRows(text).length - 1);
      selection.move({ row, column: selection.cursor?.column ?? columnAt('operator') }, 'one');
    });
  };
  const show = (made: { readonly text: string; readonly row: number; readonly count: number }) => {
    replace(made.text);
    select(made.row, columns[selection.cursor?.column ?? -1]?.id ?? 'operator', made.row + made.count - 1);
  };
  const paste = (clipboard: string, before = chosen[0] ?? null) => {
    if (clipboard !== '') change(() => show(pasteRows(model.getValue(), before, clipboard)));
  };
  const copied = () => copyRows(model.getValue(), chosen);

  /** F2: in an open cell beside what is typed, else for the operand or operator at the cursor. */
  const assist = async () => {
    const cursor = editing ?? selection.cursor;
    const row = cursor && rows[cursor.row];
    const of = editing?.of ?? (row && editedColumn(row, columns[cursor.column]?.id));
    if (cursor === null || row == null || of == null) return;
    if (of === 'comment') {
      edit(cursor);
      return;
    }
    const present = (editing === null ? null : input.openCell.current?.text()) ?? cellText(row, of);
    setEditing(null);
    const typed = /[\p{L}\p{N}_]*$/u.exec(present)?.[0] ?? '';
    const chosenText = await openDialog<string>((close) =>
      createElement(InputAssistant, { projectId: input.projectId, object: input.object, typed, close }),
    );
    input.focus();
    if (chosenText === undefined) return;
    change(() => {
      const content = present.slice(0, present.length - typed.length) + chosenText;
      replace(setCell(model.getValue(), cursor.row, of, content));
    });
  };

  return {
    change,
    edit,
    commit,
    remove,
    paste,
    copied,
    newRow: () => change(() => newRow()),
    /** Rows dropped in front of a row; those of another table come as text. */
    move: (dropped: readonly number[], before: number, copy: boolean) =>
      change(() => show(moveRows(model.getValue(), dropped, before, copy))),
    negate: () => {
      if (chosen.every((row) => rows[row] === undefined || negatedOf(rows[row]) === null))
        notify({ tone: 'info', title: t('il.negateNone') });
      else change(() => replace(negateRows(model.getValue(), chosen)));
    },
    toggleNetwork: () => {
      const networks = new Map(chosen.map((row) => [rows[row]?.network, row]));
      if (chosen.length > 0) change(() => replace([...networks.values()].reduce(toggleNetwork, model.getValue())));
    },
    cut: () => {
      const text = copied();
      remove();
      return text;
    },
    label: () =>
      change(() => {
        const made = insertLabel(model.getValue(), selection.cursor?.row ?? 0);
        editAfter(made.text, made.row, 'operator');
      }),
    selectAll: () => {
      selection.move({ row: 0, column: selection.cursor?.column ?? columnAt('operator') }, 'one');
      selection.move({ row: rows.length - 1, column: selection.cursor?.column ?? columnAt('operator') }, 'range');
    },
    leaveCell: () => setEditing(null),
    assist,
    definition: () => goToDefinition(input.place),
    suggest: () => {
      if (editing !== null) input.openCell.current?.suggest();
    },
  };
}
