import {
  useCallback,
  useEffect,
  useImperativeHandle,
  useMemo,
  useRef,
  useState,
  type DragEvent,
  type KeyboardEvent,
  type ReactNode,
  type Ref,
} from 'react';
import { ArrowDownToLine } from 'lucide-react';
import { useText } from '@/i18n';
import { Grid, type GridColumn, type GridEditing, type GridHandle } from '@/ui/grid/Grid';
import { useGridSelection, type GridSelection } from '@/ui/grid/useGridSelection';
import type { MenuEntry } from '@/ui/Menu';
import { guard } from '@/ui/notices';
import { ContextMenu } from '@/ui/Menu';
import type { OnlineSession } from '@/workbench/onlineSession';
import { fillTransfer } from '@/workbench/expressionDrag';
import type { NumberFormat } from '@/text/settings';
import { ComputedCell } from './ComputedCell';
import { copyChosen } from './copyRows';
import { NameCell } from './NameCell';
import styles from './OnlineTable.module.css';
import { PreparedCell, PreparedEditor } from './PreparedCell';
import { refusePast } from './past/refuse';
import { symbolKey } from './rowMenu';
import { togglePrepared } from './toggle';
import { flatten, isExpandable, isVariable, watchedExpressions, type OnlineRoot, type OnlineRow } from './treeRows';
import { arrayAround } from './indexJump';
import { useIndexJump } from './useIndexJump';
import { useItems } from './useItems';
import { useChildren } from './useChildren';
import { useWatched } from './useLive';
import { ValueCell } from './ValueCell';
import { ValueLayer } from './ValueLayer';
import { ValuePainter } from './valuePainter';

export interface OnlineTableHandle {
  /** The row and the column of the cursor; null where there is none. */
  cursor: () => { row: OnlineRow; column: string } | null;
  /** All rows in order, also those beyond the screen. */
  rows: () => readonly OnlineRow[];
  focus: () => void;
}

export interface OnlineTableProps {
  label: string;
  session: OnlineSession | null;
  roots: readonly OnlineRoot[];
  columns: readonly GridColumn[];
  /** Edits the first column of a root (watch lists); without it expressions stand fast. */
  expressionEditor?: (row: OnlineRow, initial: string | undefined, done: () => void) => ReactNode;
  onKey?: (event: KeyboardEvent, rows: readonly OnlineRow[]) => boolean;
  menu?: (rows: readonly OnlineRow[]) => readonly MenuEntry[];
  empty?: ReactNode;
  /** Called when the table gets the focus, with a way to ask for the selected expressions. */
  onFocus?: (chosen: () => readonly string[]) => void;
  /** Number format of a row; undefined: that of the editors. Should stay the same function. */
  formatOf?: (row: OnlineRow) => NumberFormat | undefined;
  /** Cells of columns that the table does not know. Should stay the same function. */
  extraCell?: (row: OnlineRow, column: string) => ReactNode;
  /** Whether its panel is in front: no value is asked for in one that is not. */
  visible?: boolean;
  handle?: Ref<OnlineTableHandle>;
}

/** Variables with type, value and prepared value; structured ones open. The table of watch lists and declarations. */
export function OnlineTable(props: OnlineTableProps) {
  const { session, roots, columns, formatOf, extraCell } = props;
  const t = useText();
  const runtimeId = session?.runtimeId ?? null;
  const [open, setOpen] = useState<ReadonlySet<string>>(new Set());
  const [editing, setEditing] = useState<GridEditing | null>(null);
  const onScreen = useRef<OnScreenHandle>(null);
  const [painter] = useState(() => new ValuePainter());
  const expressions = useMemo(
    () =>
      roots
        .filter((r) => r.kind === undefined && r.valueless !== true && r.computed === undefined)
        .map((r) => r.expression),
    [roots],
  );
  const items = useItems(runtimeId, session?.runtime?.code_id ?? null, expressions);
  const typed = useMemo(() => roots.map((root) => ({ ...items.get(root.expression), ...root })), [roots, items]);
  const children = useChildren(session, typed, open);
  const rows = useMemo(() => flatten(typed, open, children), [typed, open, children]);
  const selection = useGridSelection(rows.length);
  const chosen = [...selection.selected].sort((a, b) => a - b).flatMap((index) => rows[index] ?? []);
  const chosenNow = useRef(chosen);
  useEffect(() => {
    chosenNow.current = chosen;
  });

  const grid = useRef<GridHandle>(null);
  useImperativeHandle(props.handle, () => ({
    cursor: () => {
      const row = rows[selection.cursor?.row ?? -1];
      const column = columns[selection.cursor?.column ?? -1]?.id;
      return row === undefined || column === undefined ? null : { row, column };
    },
    rows: () => rows,
    focus: () => grid.current?.focus(),
  }));

  const toggleOpen = useCallback(
    (row: OnlineRow, wanted?: boolean) =>
      setOpen((before) => {
        const next = new Set(before);
        if (wanted ?? !before.has(row.key)) next.add(row.key);
        else next.delete(row.key);
        return next;
      }),
    [],
  );
  const openAll = useCallback((keys: readonly string[]) => setOpen((before) => new Set([...before, ...keys])), []);
  const { move } = selection;
  const showRow = useCallback((row: number) => move({ row, column: 0 }, 'one'), [move]);
  const askIndex = useIndexJump({ session, rows, open: openAll, show: showRow });
  const arrayHere = () => (selection.cursor === null ? null : arrayAround(rows, selection.cursor.row));
  const goToIndex = () => {
    const array = arrayHere();
    if (array !== null) void guard(() => askIndex(array));
  };
  const columnOf = (cell: { column: number }) => columns[cell.column]?.id;
  const edit = (cell: GridEditing) => {
    const row = rows[cell.row];
    if (row === undefined) return;
    if (columnOf(cell) === 'expression' && row.depth === 0 && props.expressionEditor) setEditing(cell);
    else if (columnOf(cell) === 'expression' && isExpandable(row)) toggleOpen(row);
    else if (runtimeId !== null && isVariable(row)) {
      const column = columns.findIndex((c) => c.id === 'prepared');
      if (refusePast(runtimeId)) return;
      if (cell.initial === undefined && togglePrepared(runtimeId, row.expression)) return;
      setEditing({ ...cell, column });
    }
  };
  const onKey = (event: KeyboardEvent): boolean => {
    if (props.onKey?.(event, chosen) === true) return true;
    const cursor = selection.cursor;
    const row = cursor === null ? undefined : rows[cursor.row];
    if (symbolKey(event, row)) return true;
    if (isControl(event, 'c') && chosen.length > 0)
      return (event.preventDefault(), copyChosen(runtimeId, chosen), true);
    if (isControl(event, 'g')) return (event.preventDefault(), event.stopPropagation(), goToIndex(), true);
    if (cursor === null || row === undefined) return false;
    if (columnOf(cursor) === 'expression' && isExpandable(row)) {
      if (event.key === 'ArrowRight' && row.open === false)
        return (event.preventDefault(), toggleOpen(row, true), true);
      if (event.key === 'ArrowLeft' && row.open === true) return (event.preventDefault(), toggleOpen(row, false), true);
    }
    if (event.key === ' ') return (event.preventDefault(), edit(cursor), true);
    return false;
  };
  const close = () => setEditing(null);
  const entries = (): readonly MenuEntry[] => {
    const { cursor } = selection;
    const row = rows[cursor?.row ?? -1];
    const fixed = row === undefined || !isVariable(row);
    const prepareEntry: MenuEntry = {
      kind: 'item',
      key: 'prepare',
      text: t('online.prepareValue'),
      shortcut: 'Enter',
      disabledReason: runtimeId === null ? t('reason.notLoggedIn') : fixed ? t('online.nothingToPrepare') : null,
      run: () => cursor && edit({ ...cursor, column: columns.findIndex((column) => column.id === 'prepared') }),
    };
    const indexEntry: MenuEntry = {
      kind: 'item',
      key: 'index',
      text: t('online.goToIndexMore'),
      icon: ArrowDownToLine,
      shortcut: 'Ctrl+G',
      disabledReason:
        runtimeId === null ? t('reason.notLoggedIn') : arrayHere() === null ? t('online.index.choose') : null,
      run: goToIndex,
    };
    if (props.menu === undefined) return [];
    // A table without an array need not speak of indices.
    const withArrays = rows.some(({ kind }) => kind === 'array' || kind === 'part');
    return [prepareEntry, ...(withArrays ? [indexEntry] : []), ...props.menu(chosen)];
  };
  const lost = session !== null && session.lostSince !== null;

  // Rows are drawn again when these functions are others: not with each state that the runtime tells of itself.
  const cell = useCallback(
    (index: number, column: GridColumn): ReactNode => {
      const row = rows[index];
      if (row === undefined) return null;
      switch (column.id) {
        case 'expression':
          return <NameCell row={row} runtimeId={runtimeId} onToggle={toggleOpen} />;
        case 'type':
          return <span className={styles.type}>{row.type}</span>;
        case 'value':
          if (row.expression === '') return null;
          if (row.computed !== undefined)
            return <ComputedCell runtimeId={runtimeId} computed={row.computed} lost={lost} format={formatOf?.(row)} />;
          return row.valueless === true ? (
            <span className={styles.unknown}>???</span>
          ) : (
            <ValueCell
              runtimeId={runtimeId}
              row={row}
              lost={lost}
              painter={painter}
              index={index}
              format={formatOf?.(row)}
            />
          );
        case 'prepared':
          return <PreparedCell runtimeId={runtimeId} row={row} />;
        case 'address':
          return row.address === undefined ? null : <span>{row.address}</span>;
        case 'comment':
          return row.comment === undefined ? null : <span className={styles.muted}>{row.comment.split('\n')[0]}</span>;
        default:
          return extraCell?.(row, column.id) ?? null;
      }
    },
    [rows, runtimeId, lost, toggleOpen, painter, formatOf, extraCell],
  );
  const hintOf = useCallback((index: number, column: GridColumn) => hint(t, rows[index], column.id), [t, rows]);
  const level = useCallback((index: number) => (rows[index]?.depth ?? 0) + 1, [rows]);
  const expanded = useCallback((index: number) => rows[index]?.open, [rows]);
  const editor = (what: GridEditing): ReactNode => {
    const row = rows[what.row];
    if (row === undefined) return null;
    if (columnOf(what) === 'expression') return props.expressionEditor?.(row, what.initial, close);
    return <PreparedEditor runtimeId={runtimeId ?? ''} row={row} initial={what.initial} onDone={close} />;
  };
  return (
    <ContextMenu entries={entries}>
      <div
        className={styles.table}
        onFocus={() => props.onFocus?.(() => chosenNow.current.map((row) => row.expression))}
      >
        <OnScreen ref={onScreen} runtimeId={props.visible === false ? null : runtimeId} rows={rows} />
        <Grid
          ref={grid}
          label={props.label}
          columns={columns}
          count={rows.length}
          keyOf={(index) => rows[index]?.key ?? String(index)}
          cell={cell}
          layer={{ column: 'value', draw: (place) => <ValueLayer painter={painter} place={place} /> }}
          hint={hintOf}
          level={level}
          expanded={expanded}
          selected={selection.selected}
          cursor={selection.cursor}
          onCursor={selection.move}
          editing={editing}
          editor={editor}
          onEdit={edit}
          opensOnClick={(column) => runtimeId !== null && (column.id === 'value' || column.id === 'prepared')}
          onKey={onKey}
          onRange={(first, last) => onScreen.current?.show(first, last)}
          onDragRow={(index, event) => drag(event, rows, index, selection)}
          empty={props.empty}
        />
      </div>
    </ContextMenu>
  );
}

function isControl({ key, ctrlKey, metaKey, shiftKey, altKey }: KeyboardEvent, letter: string): boolean {
  return key.toLowerCase() === letter && (ctrlKey || metaKey) && !shiftKey && !altKey;
}

interface OnScreenHandle {
  show: (first: number, last: number) => void;
}

/** Rows are asked for in blocks: a row that scrolls into view does not change the subscription each time. */
const BLOCK = 20;

interface OnScreenProps {
  runtimeId: string | null;
  rows: readonly OnlineRow[];
  ref: Ref<OnScreenHandle>;
}

/** Watches the rows on screen and some around them; scrolling draws this again, not the table. */
function OnScreen({ runtimeId, rows, ref }: OnScreenProps) {
  const [range, setRange] = useState({ first: 0, last: 3 * BLOCK });
  useImperativeHandle(
    ref,
    () => ({
      show: (top, bottom) => {
        const first = (Math.floor(top / BLOCK) - 1) * BLOCK;
        const last = (Math.floor(bottom / BLOCK) + 2) * BLOCK - 1;
        setRange((before) => (before.first === first && before.last === last ? before : { first, last }));
      },
    }),
    [],
  );
  const expressions = useMemo(() => watchedExpressions(rows, range.first, range.last), [rows, range]);
  useWatched(runtimeId, expressions);
  return null;
}

function drag(event: DragEvent, rows: readonly OnlineRow[], index: number, selection: GridSelection): void {
  const many = selection.selected.has(index) ? [...selection.selected].sort((a, b) => a - b) : [index];
  const expressions = many.flatMap((i) => rows[i]?.expression ?? []).filter((expression) => expression !== '');
  fillTransfer(event.dataTransfer, expressions);
}

function hint(t: ReturnType<typeof useText>, row: OnlineRow | undefined, column: string): string | undefined {
  if (row === undefined) return undefined;
  if (column === 'expression') return row.expression;
  if (column === 'type') return row.type;
  if (column === 'comment') return row.comment;
  if (column === 'value' && row.valueless === true) return t('online.noValue');
  return undefined;
}
