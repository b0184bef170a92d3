import { ArrowDown, ArrowUp, ListPlus, Trash2 } from 'lucide-react';
import { useEffect, useMemo, useRef, useState, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import { setPanelTable } from '@/text/focus';
import { Select } from '@/ui/Field';
import { CellInput } from '@/ui/grid/CellInput';
import { Grid, type GridColumn, type GridEditing } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { ContextMenu, type MenuEntry } from '@/ui/Menu';
import { useColumns } from '../cnc_settings/columns';
import styles from './Cnc.module.css';
import type { CncDocument } from './cncDocument';
import { lineEdit } from './edits';
import { readBlock } from './line';
import { aboutCode, aboutLetter } from './meaning';
import {
  appended,
  appliedToAll,
  cellFault,
  cellOf,
  isAvailable,
  letterOf,
  moved,
  newElement,
  ROW_TYPES,
  rowCount,
  rowOf,
  typeOf,
  withCell,
  withType,
  type Column,
  type Row,
} from './table';
import { useProgramVersion } from './useProgramVersion';

interface CncGridProps {
  panelId: string;
  projectId: string;
  objectId: string;
  name: string;
  program: CncDocument;
  locked: boolean;
  line: number;
  onLine: (line: number) => void;
}

const TYPE = 'type';
const WIDTHS: Readonly<Partial<Record<Column, number>>> = { n: 64, comment: 180, acceleration: 70, deceleration: 70 };

/** The program as a table: a row a block, each change an edit of the text (CNC-40 to CNC-48). */
export function CncGrid({ panelId, projectId, objectId, name, program, locked, line, onLine }: CncGridProps) {
  const t = useText();
  const version = useProgramVersion(program);
  const shown = useColumns(projectId, objectId);
  const [editing, setEditing] = useState<GridEditing | null>(null);
  const count = program.program.count;
  const rows = rowCount(count, program.program.block(count - 1).text);
  const selection = useGridSelection(rows + 1);
  const { cursor, move } = selection;
  const area = useRef<HTMLDivElement>(null);

  useEffect(() => {
    const { model } = program;
    // Of Monaco's models, beyond their published types.
    const history = model as unknown as Record<'undo' | 'redo', () => void>;
    const entered = () => setPanelTable(panelId, { undo: () => history.undo(), redo: () => history.redo() });
    const node = area.current;
    node?.addEventListener('focusin', entered);
    return () => {
      node?.removeEventListener('focusin', entered);
      setPanelTable(panelId, null);
    };
  }, [panelId, program]);
  useEffect(() => {
    if (cursor?.row !== line && line < rows) move({ row: line, column: cursor?.column ?? 1 }, 'one');
    // Follows the text, not its own cursor.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [line]);

  const columns = useMemo(
    (): GridColumn[] => [
      { id: TYPE, title: t('cnc.type'), width: 92, code: true },
      ...shown.map((column): GridColumn => ({
        id: column,
        title: t(`cnc.column.${column}`),
        width: WIDTHS[column] ?? 76,
        grow: column === 'comment',
        align: column === 'comment' ? undefined : 'right',
        code: column !== 'comment',
      })),
    ],
    [t, shown],
  );
  const at = useMemo(() => {
    void version; // Rows are read again with every change.
    return (row: number): Row => rowOf(program.program.block(row), program.program.stateBefore(row));
  }, [program, version]);

  const cell = useMemo(
    () =>
      (row: number, { id }: GridColumn) => {
        if (row >= rows) return id === TYPE && !locked ? <span className={styles.muted}>{t('cnc.new')}</span> : null;
        const found = at(row);
        if (id === TYPE) {
          const type = typeOf(found);
          return 'text' in type ? type.text : <span className={styles.muted}>{t(type.key)}</span>;
        }
        const column = id as Column;
        if (!isAvailable(found, column)) return <span className={styles.none} />;
        const { text, modal } = cellOf(found, column);
        return <span className={modal || found.textOnly ? styles.muted : undefined}>{text}</span>;
      },
    [at, rows, locked, t],
  );
  const hint = (row: number, { id }: GridColumn) => {
    if (row >= rows) return undefined;
    const found = at(row);
    if (id === TYPE)
      return found.act.kind === 'g' || found.act.kind === 'travel' ? aboutCode(found.act.code) : undefined;
    const column = id as Column;
    if (found.textOnly) return t('cnc.onlyText');
    if (!isAvailable(found, column)) return t('cnc.notHere');
    const { text, modal } = cellOf(found, column);
    if (modal && text !== '') return t('cnc.modal', { value: text });
    return column === 'comment' ? undefined : aboutLetter(letterOf(column), found.act, found.block, found.state);
  };
  const canEdit = (row: number, id: string) => {
    if (locked) return false;
    if (row >= rows) return id === TYPE;
    const found = at(row);
    return !found.textOnly && (id === TYPE || isAvailable(found, id as Column));
  };
  const columnOf = (index: number) => columns[index]?.id ?? '';
  const go = (row: number, column: number) => {
    move({ row, column }, 'one');
    if (row < rows) onLine(row);
  };
  const change = (row: number, text: string) => {
    if (row < rows && text !== at(row).block.text) program.apply([lineEdit(row, text)]);
  };
  const chooseType = (row: number, type: string) => {
    setEditing(null);
    const last = program.program.block(count - 1).text;
    if (row < rows) change(row, withType(at(row).block, type));
    else program.apply([appended(count, last, withType(readBlock(newElement(blockAt(rows - 1), undefined)), type))]);
  };
  const blockAt = (row: number) => (row >= 0 && row < rows ? program.program.block(row) : undefined);
  const insert = (row: number, behind: boolean) => {
    const before = behind ? row : row - 1;
    const text = newElement(blockAt(before), blockAt(before + 1));
    program.apply([
      row >= rows
        ? appended(count, program.program.block(count - 1).text, text)
        : { from: before + 1, removed: 0, lines: [text] },
    ]);
    go(before + 1, cursor?.column ?? 0);
  };
  const chosen = () => [...selection.selected].filter((row) => row < rows).sort((a, b) => a - b);
  const remove = () => {
    const gone = chosen();
    program.apply(gone.map((row) => ({ from: row, removed: 1, lines: [] })));
    if (gone[0] !== undefined) go(Math.min(gone[0], Math.max(0, rows - gone.length - 1)), cursor?.column ?? 0);
  };
  const shift = (by: -1 | 1) => {
    const all = chosen();
    const [first, last] = [all[0], all.at(-1)];
    if (first === undefined || last === undefined) return;
    const edit = moved(program.lines(), first, last, by, rows);
    if (edit === null) return;
    program.apply([edit]);
    move({ row: first + by, column: cursor?.column ?? 0 }, 'one');
    if (last > first) move({ row: last + by, column: cursor?.column ?? 0 }, 'range');
    onLine(first + by);
  };
  const onKey = (event: KeyboardEvent): boolean => {
    if (locked || cursor === null) return false;
    if (event.altKey && event.key === 'ArrowUp') shift(-1);
    else if (event.altKey && event.key === 'ArrowDown') shift(1);
    else if (event.key === 'Delete') remove();
    else if (event.key === 'Insert') insert(cursor.row, event.shiftKey);
    else return false;
    event.preventDefault();
    event.stopPropagation();
    return true;
  };
  const applyToAll = (row: number, column: Column) => {
    const { text } = cellOf(at(row), column);
    const all = function* () {
      for (let index = 0; index < rows; index++)
        yield rowOf(program.program.block(index), program.program.stateBefore(index));
    };
    program.apply(appliedToAll(all(), column, text));
  };
  const entries = (): MenuEntry[] => {
    if (cursor === null) return [];
    const reason = locked ? t('cnc.locked') : null;
    const row = cursor.row;
    const column = columnOf(cursor.column);
    const value = row < rows && column !== TYPE && canEdit(row, column) && column !== 'n';
    return [
      {
        kind: 'item',
        key: 'before',
        text: t('cnc.insertBefore'),
        icon: ListPlus,
        disabledReason: reason,
        run: () => insert(row, false),
      },
      { kind: 'item', key: 'after', text: t('cnc.insertAfter'), disabledReason: reason, run: () => insert(row, true) },
      { kind: 'item', key: 'up', text: t('cnc.moveUp'), icon: ArrowUp, disabledReason: reason, run: () => shift(-1) },
      {
        kind: 'item',
        key: 'down',
        text: t('cnc.moveDown'),
        icon: ArrowDown,
        disabledReason: reason,
        run: () => shift(1),
      },
      {
        kind: 'item',
        key: 'all',
        text: t('cnc.applyToAll'),
        disabledReason: reason ?? (value ? null : t('cnc.noValue')),
        run: () => applyToAll(row, column as Column),
      },
      { kind: 'item', key: 'delete', text: t('cnc.delete'), icon: Trash2, disabledReason: reason, run: remove },
    ];
  };

  return (
    <ContextMenu entries={entries}>
      <div className={styles.table} ref={area}>
        <Grid
          label={t('cnc.tableOf', { name })}
          columns={columns}
          count={rows + 1}
          keyOf={String}
          cell={cell}
          hint={hint}
          selected={selection.selected}
          cursor={cursor}
          onCursor={(place, how) => {
            move(place, how);
            if (place.row < rows) onLine(place.row);
          }}
          editing={editing}
          editor={(place) => {
            const id = columnOf(place.column);
            if (id === TYPE)
              return (
                <TypeCell
                  label={t('cnc.type')}
                  row={place.row < rows ? at(place.row) : null}
                  onType={(type) => chooseType(place.row, type)}
                />
              );
            const column = id as Column;
            const found = at(place.row);
            return (
              <CellInput
                label={t(`cnc.column.${column}`)}
                value={cellOf(found, column).modal ? '' : cellOf(found, column).text}
                initial={place.initial}
                check={(text) => {
                  const fault = cellFault(column, text);
                  return fault === null ? null : t(fault);
                }}
                onCommit={(text, key, backwards) => {
                  setEditing(null);
                  change(place.row, withCell(found.block, column, text));
                  if (key === 'Enter') go(Math.min(place.row + 1, rows), place.column);
                  if (key === 'Tab')
                    go(place.row, Math.max(0, Math.min(columns.length - 1, place.column + (backwards ? -1 : 1))));
                }}
                onCancel={() => setEditing(null)}
              />
            );
          }}
          onEdit={(place) => {
            if (canEdit(place.row, columnOf(place.column))) setEditing(place);
          }}
          onKey={onKey}
          onEmptyClick={selection.clear}
        />
      </div>
    </ContextMenu>
  );
}

function TypeCell({ label, row, onType }: { label: string; row: Row | null; onType: (type: string) => void }) {
  const t = useText();
  const present = row === null ? { text: '' } : typeOf(row);
  const value = 'text' in present ? present.text : '';
  const choices = ROW_TYPES.map((type) => ({
    value: type,
    text: `${type} ${type === 'M' ? t('cnc.letter.M') : (aboutCode(Number(type.slice(1))) ?? '')}`,
  }));
  const known = ROW_TYPES.includes(value);
  return (
    <Select
      compact
      label={label}
      value={value}
      choices={known ? choices : [{ value, text: value }, ...choices]}
      onValue={onType}
    />
  );
}
