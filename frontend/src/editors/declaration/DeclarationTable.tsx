import { ArrowDown, ArrowUp, ListPlus, TextInitial, Trash2 } from 'lucide-react';
import { useCallback, useMemo, useRef, useState, type KeyboardEvent } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useBookmarkedLines } from '@/bookmarks/marks';
import { useText } from '@/i18n';
import { goToDefinition } from '@/lsp/definition';
import type { Position } from '@/lsp/protocol';
import type { EditorProps } from '@/project/editorProps';
import { Button, IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { ContextMenu, type MenuEntry } from '@/ui/Menu';
import { activeDescendant, openMenuAt } from '@/ui/menuKey';
import { partUri } from '@/project/partUri';
import type { OpenText } from '@/text/useTextDocument';
import { useModelText } from '@/text/useModelText';
import { useRowPlace } from '@/text/useRowPlace';
import { Grid, type GridEditing, type GridHandle } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { setPanelTable } from '@/text/focus';
import { fillTransfer } from '@/workbench/expressionDrag';
import { quickFixEntries } from '../text/quickFixes';
import { showCrossReferences, variablesOf } from '../text/acts';
import { symbolEntries } from '../text/TextMenu';
import { useEditingLock } from '../text/useEditingLock';
import { CellEditor } from './CellEditor';
import styles from './DeclarationTable.module.css';
import { HeaderLine } from './HeaderLine';
import { rowsInLines } from '@/iec/declaration/lines';
import { parseDeclaration } from '@/iec/declaration/parse';
import { placeOf, problemText } from './problemText';
import { DRAFT_KEY, displayOrder, type Draft, type Sorting } from './tableModel';
import { cellContent, tableColumns } from './tableView';
import { useTableActs } from './useTableActs';

function positionAt(text: string, offset: number): Position {
  const { line, column } = placeOf(text, offset);
  return { line: line - 1, character: column - 1 };
}

type DeclarationTableProps = EditorProps & OpenText & { object: ObjectSummary; showText: () => void };

/** The declaration as numbered rows; every edit changes the one text in place (DECL-20 .. DECL-36). */
export function DeclarationTable(props: DeclarationTableProps) {
  const { panelId, projectId, document, monaco, object, instance, showText } = props;
  const t = useText();
  const text = useModelText(document.models.declaration);
  const model = useMemo(() => parseDeclaration(text), [text]);
  const lines = useBookmarkedLines({ objectId: object.id, part: 'declaration' });
  const bookmarked = useMemo(() => rowsInLines(model, lines), [model, lines]);
  const locked = useEditingLock(object, null);
  const [editing, setEditing] = useState<GridEditing | null>(null);
  const [draft, setDraft] = useState<Draft | null>(null);
  const [sorting, setSorting] = useState<Sorting | null>(null);
  const grid = useRef<GridHandle>(null);
  const area = useRef<HTMLDivElement>(null);
  const columns = useMemo(() => tableColumns(t, model), [t, model]);
  const shown = useMemo(() => displayOrder(model, draft, sorting), [model, draft, sorting]);
  const selection = useGridSelection(shown.length);
  const acts = useTableActs({
    document,
    model,
    shown,
    selection,
    draft,
    setDraft,
    setEditing,
    setSorting,
    locked,
    columns,
  });

  const place = useRowPlace({
    monaco,
    document,
    model,
    cursor: () => ({
      row: shown[selection.cursor?.row ?? -1],
      column: columns[selection.cursor?.column ?? -1]?.id,
    }),
    focus: () => grid.current?.focus(),
  });
  const onFocus = useCallback(() => {
    const history = document.models.declaration as unknown as { undo: () => void; redo: () => void };
    const showFixes = () => {
      const table = area.current?.querySelector('[role="grid"]');
      if (table) openMenuAt(activeDescendant(table));
    };
    setPanelTable(panelId, {
      undo: () => history.undo(),
      redo: () => history.redo(),
      place,
      acts: {
        'st.quickFix': showFixes,
        'st.goToDefinition': () => goToDefinition(place),
        'st.peekReferences': () => showCrossReferences({ monaco, document, projectId, object, instance }, place),
      },
    });
  }, [document, panelId, place, monaco, projectId, object, instance]);

  const serious = model.problems.filter((problem) => problem.kind !== 'not-tabular');
  const problem = serious[0] ?? model.problems[0];
  if (problem !== undefined) {
    const { line, column } = placeOf(text, problem.start);
    return (
      <Empty
        icon={TextInitial}
        title={serious.length > 0 ? t('decl.notReadable') : t('decl.notTabular')}
        text={
          serious.length > 0
            ? t('decl.problemAt', { line, column, problem: problemText(problem) })
            : t('decl.notTabularText')
        }
      >
        <Button variant="primary" onClick={showText}>
          {t('decl.showText')}
        </Button>
      </Empty>
    );
  }

  const onKey = (event: KeyboardEvent): boolean => {
    if (event.key === 'Delete') return (acts.remove(), true);
    if (event.key === 'Insert') return (acts.insert(true), true);
    if (event.altKey && event.key === 'ArrowUp') return (event.preventDefault(), acts.move(-1), true);
    if (event.altKey && event.key === 'ArrowDown') return (event.preventDefault(), acts.move(1), true);
    if (event.key === ' ' && selection.cursor) return (event.preventDefault(), acts.edit(selection.cursor), true);
    return false;
  };
  /** Quick fixes for the messages of the row with the cursor. */
  const fixes = async (): Promise<MenuEntry[]> => {
    const row = model.rows[shown[selection.cursor?.row ?? -1] ?? DRAFT_KEY];
    if (row === undefined || locked) return [];
    const range = { start: positionAt(text, row.element.start), end: positionAt(text, row.element.end) };
    const found = await quickFixEntries(projectId, partUri(projectId, object.id, 'declaration'), range);
    return found.length === 0 ? [] : [...found, { kind: 'line', key: 'fixes' }];
  };
  const entries = async (): Promise<MenuEntry[]> => [
    ...(await fixes()),
    ...(selection.cursor === null ? [] : symbolEntries()),
    {
      kind: 'item',
      key: 'insert',
      text: t('decl.insert'),
      icon: ListPlus,
      shortcut: 'Ins',
      disabledReason: acts.reason.edit,
      run: () => acts.insert(true),
    },
    {
      kind: 'item',
      key: 'append',
      text: t('decl.append'),
      disabledReason: acts.reason.edit,
      run: () => acts.insert(false),
    },
    { kind: 'line', key: 'l1' },
    {
      kind: 'item',
      key: 'up',
      text: t('decl.moveUp'),
      icon: ArrowUp,
      shortcut: 'Alt+\u2191',
      disabledReason: acts.reason.one,
      run: () => acts.move(-1),
    },
    {
      kind: 'item',
      key: 'down',
      text: t('decl.moveDown'),
      icon: ArrowDown,
      shortcut: 'Alt+\u2193',
      disabledReason: acts.reason.one,
      run: () => acts.move(1),
    },
    { kind: 'line', key: 'l2' },
    {
      kind: 'item',
      key: 'delete',
      text: t('decl.delete'),
      icon: Trash2,
      shortcut: 'Del',
      danger: true,
      disabledReason: acts.reason.some,
      run: acts.remove,
    },
  ];

  return (
    <div className={styles.table} onFocusCapture={onFocus}>
      <div className={styles.bar}>
        <HeaderLine object={object} document={document} model={model} locked={locked} />
        <IconButton
          small
          icon={ListPlus}
          label={t('decl.insert')}
          shortcut="Ins"
          disabledReason={acts.reason.edit}
          onClick={() => acts.insert(true)}
        />
        <IconButton
          small
          icon={Trash2}
          label={t('decl.delete')}
          shortcut="Del"
          disabledReason={acts.reason.some}
          onClick={acts.remove}
        />
        <IconButton
          small
          icon={ArrowUp}
          label={t('decl.moveUp')}
          shortcut={'Alt+\u2191'}
          disabledReason={acts.reason.one}
          onClick={() => acts.move(-1)}
        />
        <IconButton
          small
          icon={ArrowDown}
          label={t('decl.moveDown')}
          shortcut={'Alt+\u2193'}
          disabledReason={acts.reason.one}
          onClick={() => acts.move(1)}
        />
      </div>
      <ContextMenu entries={entries}>
        <div ref={area} className={styles.grid}>
          <Grid
            ref={grid}
            label={t('decl.tableOf', { name: object.name })}
            columns={columns}
            count={shown.length}
            keyOf={(row) => (shown[row] === DRAFT_KEY ? 'draft' : String(shown[row]))}
            cell={(row, column) => cellContent({ t, model, draft, bookmarked }, shown[row] ?? -1, column.id)}
            hint={(row, column) => acts.hint(row, column.id)}
            selected={selection.selected}
            cursor={selection.cursor}
            onCursor={selection.move}
            editing={editing}
            editor={(cell) => (
              <CellEditor
                key={`${String(cell.row)}.${String(cell.column)}`}
                column={columns[cell.column]?.id ?? 'name'}
                row={shown[cell.row] ?? -1}
                initial={cell.initial}
                model={model}
                draft={draft}
                object={object}
                monaco={monaco}
                onCommit={acts.commit}
                onCancel={acts.cancel}
              />
            )}
            onEdit={acts.edit}
            onDragRow={(row, event) => {
              const many = selection.selected.has(row) ? [...selection.selected].sort((a, b) => a - b) : [row];
              const rows = many.flatMap((index) => model.rows[shown[index] ?? DRAFT_KEY] ?? []);
              const variables = variablesOf({ projectId, object, instance }, text, rows);
              if (variables.length === 0) event.preventDefault();
              else fillTransfer(event.dataTransfer, variables);
            }}
            onKey={onKey}
            onEmptyClick={selection.clear}
            sorting={sorting}
            onSort={acts.sort}
            rowState={(row) => (model.rows[shown[row] ?? -1]?.special != null ? 'special' : undefined)}
            empty={<Empty title={t('decl.empty')} text={t('decl.emptyText')} />}
          />
        </div>
      </ContextMenu>
    </div>
  );
}
