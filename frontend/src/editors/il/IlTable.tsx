import { useEffect, useMemo, useRef, useState, type ClipboardEvent, type KeyboardEvent } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useBookmarkedLines } from '@/bookmarks/marks';
import { useText } from '@/i18n';
import { LostBar } from '@/online/LostBar';
import online from '@/online/OnlineTable.module.css';
import { languageClient } from '@/lsp/session';
import type { EditorProps } from '@/project/editorProps';
import { exceptionTitle } from '@/workbench/online/exception';
import { setCursor } from '@/workbench/selection';
import { ContextMenu } from '@/ui/Menu';
import { useModelText } from '@/text/useModelText';
import type { OpenText } from '@/text/useTextDocument';
import type { CellInputHandle } from '@/ui/grid/CellInput';
import { Grid, type GridHandle } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { faultLine } from '../online/useFaultLine';
import { useMonitored } from '../online/useOnlineView';
import type { TextPlace } from '@/text/focus';
import { useEditingLock } from '../text/useEditingLock';
import { focusIsFree } from '../text/useReveal';
import { cellContent, cellHint, ilColumns, type ColumnId } from './columns';
import { operandName, useOperandFacts } from './facts';
import { IlCellEditor } from './IlCellEditor';
import styles from './IlTable.module.css';
import { ilMenu } from './menu';
import { useRowMessages } from './messages';
import { parseRows, rowAt } from './rows';
import { ilSettings } from './settings';
import { useRowBreakpoints } from './useRowBreakpoints';
import { useRowDrag } from './useRowDrag';
import { useIlActs, type IlEditing } from './useIlActs';
import { usePrepare } from './usePrepare';
import { useTableOfPanel } from './useTableOfPanel';
import { RowValues, useRowValues, withValue } from './values';

export type IlTableProps = EditorProps & OpenText & { object: ObjectSummary; inText: (action: string) => void };

/** A body in IL, one instruction a row; every edit changes the one text in place (IL-01 .. IL-08). */
export function IlTable(props: IlTableProps) {
  const { panelId, projectId, document, monaco, object, reveal, inText } = props;
  const t = useText();
  const model = document.models.implementation;
  const text = useModelText(model);
  const rows = useMemo(() => parseRows(text), [text]);
  const settings = ilSettings.use();
  const locked = useEditingLock(object, null);
  const monitored = useMonitored(props);
  const { session, runtimeId, needsInstanceOf, executed } = monitored;
  const isOnline = session !== null;
  const columns = useMemo(() => ilColumns(t, settings, isOnline), [t, settings, isOnline]);
  const selection = useGridSelection(rows.length);
  const [editing, setEditing] = useState<IlEditing | null>(null);
  const [range, setRange] = useState({ first: 0, last: 60 });
  const grid = useRef<GridHandle>(null);
  const openCell = useRef<CellInputHandle>(null);
  useEffect(() => {
    languageClient(monaco, projectId);
  }, [monaco, projectId]);
  const facts = useOperandFacts(monaco, document, rows);
  const messages = useRowMessages(monaco, model, rows);
  const values = useRowValues(monitored.ready && props.visible ? monitored.settings : null, text, rows, range);
  const prepare = usePrepare(runtimeId);
  const bookmarked = useBookmarkedLines({ objectId: object.id, part: 'implementation' });
  const marked = useMemo(() => new Set(bookmarked.map((line) => rowAt(rows, line))), [bookmarked, rows]);
  const breakpoints = useRowBreakpoints(session, object.id, rows);
  const fault = faultLine(session?.runtime?.exception, object.id, 'implementation');

  const { cursor, selected } = selection;
  const place = useMemo((): TextPlace => {
    const row = cursor === null ? undefined : rows[cursor.row];
    const column = cursor === null ? undefined : columns[cursor.column]?.id;
    const cell = row && (column === 'operator' ? row.operator : (row.operand ?? row.operator));
    // Behind the parenthesis or sign that it may begin with, there stands the name that commands are about.
    const at = cell == null ? row?.start : cell.start + Math.max(0, cell.text.search(/[\p{L}_]/u));
    return {
      getModel: () => model,
      getPosition: () => (at === undefined ? null : model.getPositionAt(at)),
      getSelection: () => {
        const ends = [...selected].flatMap((index) => rows[index] ?? []);
        if (ends.length === 0) return null;
        const from = model.getPositionAt(Math.min(...ends.map(({ start }) => start)));
        const to = model.getPositionAt(Math.max(...ends.map(({ end }) => end)));
        return monaco.Selection.fromPositions(from, to);
      },
      focus: () => grid.current?.focus(),
    };
  }, [cursor, selected, rows, columns, model, monaco]);
  const acts = useIlActs({
    projectId,
    object,
    document,
    rows,
    columns,
    selection,
    locked,
    editing,
    setEditing,
    openCell,
    place,
    focus: () => grid.current?.focus(),
  });
  const drag = useRowDrag(model, acts, [...selected]);
  const enter = useTableOfPanel({ panelId, panel: props, acts, place, locked, selection, messages, inText });

  // A jump leads to the row; without a place, the table just gets the keyboard.
  const { move } = selection;
  useEffect(() => {
    if (reveal === null || reveal.part === 'declaration') return;
    if (reveal.line !== undefined) {
      const row = rowAt(rows, reveal.line, reveal.column);
      const found = rows[row];
      const at = found === undefined ? 0 : found.lineStart + (reveal.column ?? 1) - 1;
      const inOperand = found?.operand != null && at >= found.operand.start;
      const column = columns.findIndex(({ id }) => id === (inOperand ? 'operand' : 'operator'));
      if (row >= 0) move({ row, column }, 'one');
    }
    if (reveal.focus && focusIsFree(panelId)) grid.current?.focus();
    // Once for each jump, whatever happens to the rows later.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [reveal]);

  useEffect(() => {
    const position = place.getPosition();
    if (cursor !== null && position !== null)
      setCursor(panelId, { line: position.lineNumber, column: position.column, selected: 0 });
  }, [panelId, cursor, place]);

  const onKey = (event: KeyboardEvent): boolean => {
    const used = (run: () => void) => {
      event.preventDefault();
      run();
      return true;
    };
    const ctrl = event.ctrlKey || event.metaKey;
    // Ctrl+Del is the key of CODESYS.
    if (event.key === 'Delete' && !event.shiftKey && !event.altKey) return used(acts.remove);
    if (event.key === 'Enter' && ctrl) return used(acts.newRow);
    if (event.key.toLowerCase() === 'a' && ctrl) return used(acts.selectAll);
    if (event.key === 'Tab' && !ctrl && cursor !== null) {
      const column = cursor.column + (event.shiftKey ? -1 : 1);
      return column >= 1 && column < columns.length && used(() => selection.move({ ...cursor, column }, 'one'));
    }
    if ((event.key === ' ' || event.key === 'Enter') && !ctrl && cursor !== null) {
      const value = columns[cursor.column]?.id === 'value' ? withValue(values.get(cursor.row) ?? [])[0] : undefined;
      return used(() => (value === undefined ? acts.edit(cursor) : prepare.open(value, cursor.row)));
    }
    return false;
  };
  const clipboard = (run: (data: DataTransfer) => void) => (event: ClipboardEvent) => {
    if (event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement) return;
    event.preventDefault();
    run(event.clipboardData);
  };

  const view = (row: number) => {
    const shown = rows[row]!;
    const name = operandName(shown).toUpperCase();
    const found = messages.get(row) ?? NO_MESSAGES;
    const { toggle, marks } = breakpoints;
    return {
      t,
      row: shown,
      facts: facts.get(name) ?? null,
      messages: found,
      bookmark: marked.has(row),
      breakpoint: marks.get(row),
      onBreakpoint: toggle === null ? null : () => toggle(row),
    };
  };
  const valueCell = (row: number) => {
    if (runtimeId === null || rows[row] === undefined) return null;
    if (needsInstanceOf !== null) return rows[row].operand && <span className={styles.muted}>???</span>;
    const { line } = rows[row];
    const stale = monitored.settings?.running?.[line - 1] === false;
    return (
      <RowValues
        values={values.get(row) ?? NO_VALUES}
        operand={operandName(rows[row])}
        runtimeId={runtimeId}
        lost={monitored.settings?.lost ?? false}
        stale={stale}
        executed={(name) => executed?.valueAt(line, name) ?? null}
        onPrepare={(value) => prepare.open(value, row)}
      />
    );
  };
  const state = (row: number) => {
    const shown = rows[row];
    if (shown === undefined) return undefined;
    const wide = ['label', 'comment', 'raw'].includes(shown.kind) ? `wide ${shown.kind}` : '';
    const passed = executed?.has(shown.line) === true && shown.kind !== 'comment' && shown.kind !== 'blank';
    const marks = [
      wide,
      shown.excluded ? 'excluded' : '',
      passed ? 'executed' : '',
      shown.line === fault ? 'fault' : '',
      breakpoints.marks.get(row)?.look === 'active' ? 'break' : '',
      breakpoints.current === row ? (breakpoints.innermost ? 'halted' : 'caller') : '',
    ];
    return marks.filter(Boolean).join(' ') || undefined;
  };
  const valueColumn = columns.findIndex(({ id }) => id === 'value');

  return (
    <div
      className={styles.table}
      onFocusCapture={enter}
      onCopy={clipboard((data) => data.setData('text/plain', acts.copied()))}
      onCut={clipboard((data) => data.setData('text/plain', acts.cut()))}
      onPaste={clipboard((data) => acts.paste(data.getData('text/plain')))}
    >
      {session !== null && <LostBar session={session} />}
      {fault !== null && session?.runtime?.exception != null && (
        <div className={styles.bar}>{exceptionTitle(session.runtime.exception)}</div>
      )}
      <ContextMenu entries={() => ilMenu(t, acts, selection.selected.size)}>
        <div className={`${styles.grid} ${online.table}`} data-lost={monitored.settings?.lost === true || undefined}>
          <Grid
            ref={grid}
            label={t('il.tableOf', { name: object.name })}
            columns={columns}
            count={rows.length}
            keyOf={String}
            cell={(row, column) =>
              column.id === 'value' ? valueCell(row) : cellContent(view(row), column.id as ColumnId)
            }
            hint={(row, column) => (column.id === 'value' ? undefined : cellHint(view(row), column.id as ColumnId))}
            selected={selection.selected}
            cursor={cursor}
            onCursor={selection.move}
            editing={prepare.editing === null ? editing : { row: prepare.editing.row, column: valueColumn }}
            editor={(cell) =>
              prepare.editing !== null
                ? prepare.editor()
                : editing !== null && (
                    <IlCellEditor
                      key={`${String(cell.row)}.${editing.of}`}
                      projectId={projectId}
                      object={object}
                      document={document}
                      row={rows[cell.row]!}
                      index={cell.row}
                      column={editing.of}
                      initial={cell.initial}
                      handle={openCell}
                      onCommit={acts.commit}
                      onCancel={() => setEditing(null)}
                    />
                  )
            }
            onEdit={acts.edit}
            editOnClick={!locked}
            onKey={onKey}
            onEmptyClick={selection.clear}
            onDragRow={locked ? undefined : drag.begin}
            onDropRow={drag.target}
            onRange={(first, last) =>
              setRange((before) => (before.first === first && before.last === last ? before : { first, last }))
            }
            rowState={state}
          />
        </div>
      </ContextMenu>
    </div>
  );
}

const NO_MESSAGES: readonly never[] = [];
const NO_VALUES: readonly never[] = [];
