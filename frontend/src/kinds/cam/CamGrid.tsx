import { Minus, Plus } from 'lucide-react';
import { useEffect, useMemo, useState, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import { numberText, shortNumber, typedNumber } from '@/editors/form/numbers';
import { IconButton } from '@/ui/Button';
import { Select } from '@/ui/Field';
import { CellInput } from '@/ui/grid/CellInput';
import { Grid, type GridColumn, type GridEditing } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import styles from './Cam.module.css';
import { isEnd, LAWS, type Law } from './camTable';
import { heldReason, jerkShown, POINT_COLUMNS, pointFault, rangeOf, rounded, type PointColumn } from './cells';
import type { CamEdit } from './edit';
import { insertAt, removable, removed } from './keyActs';
import { deletePoint, movePoint, setLaw } from './points';
import { camRows, rowOf, type CamRow } from './rows';

/** Points and segments in turn, as rows (CAM-40 to CAM-47). */
export function CamGrid({ edit }: { edit: CamEdit }) {
  const t = useText();
  const { cam, drawing, locked, selected } = edit;
  const rows = useMemo(() => camRows(cam), [cam]);
  const selection = useGridSelection(rows.length);
  const [editing, setEditing] = useState<GridEditing | null>(null);
  const columns = useMemo(
    (): GridColumn[] => [
      { id: 'act', title: '', width: 34 },
      { id: 'row', title: t('cam.column.element'), width: 92 },
      ...POINT_COLUMNS.map((id) => ({
        id,
        title: t(`cam.column.${id}`),
        width: 98,
        align: 'right' as const,
        code: true,
      })),
      { id: 'law', title: t('cam.column.law'), width: 128 },
      ...(['least', 'greatest', 'velocity', 'acceleration'] as const).map((id) => ({
        id,
        title: t(`cam.column.${id}`),
        width: 106,
        align: 'right' as const,
        code: true,
      })),
    ],
    [t],
  );
  // What is selected in a graph is selected here, and the other way round.
  const chosen = selected !== null && selected.kind !== 'tappet' ? rowOf(selected) : null;
  const { move, cursor } = selection;
  useEffect(() => {
    if (chosen !== null && cursor?.row !== chosen) move({ row: chosen, column: cursor?.column ?? 1 }, 'one');
    // Follows the selection only, not the cursor.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [chosen]);

  const go = (row: number, column: number) => {
    selection.move({ row, column }, 'one');
    edit.select(rows[row] ?? null);
  };
  const change = (row: CamRow, column: string, text: string) => {
    if (row.kind === 'point') edit.change(movePoint(cam, row.index, { [column]: typedNumber(text) }));
  };
  const columnOf = (at: number) => columns[at]?.id ?? '';
  const asPoint = (id: string): PointColumn | null => POINT_COLUMNS.find((name) => name === id) ?? null;
  const canEdit = (row: CamRow, id: string): boolean => {
    if (locked) return false;
    if (row.kind === 'segment') return id === 'law';
    const name = asPoint(id);
    return name !== null && heldReason(cam, row.index, name) === null;
  };
  const cell = (at: number, { id }: GridColumn) => {
    const row = rows[at]!;
    if (id === 'act') {
      if (row.kind === 'segment')
        return (
          <IconButton
            small
            icon={Plus}
            label={t('cam.insertPoint')}
            disabledReason={locked ? t('cam.locked') : null}
            onClick={() => void insertAt({ ...edit, selected: row }, null, 'y', null)}
          />
        );
      if (isEnd(cam, row.index)) return null;
      return (
        <IconButton
          small
          icon={Minus}
          label={t('cam.deletePoint')}
          disabledReason={locked ? t('cam.locked') : null}
          onClick={() => edit.change(deletePoint(cam, row.index), { kind: 'segment', index: row.index - 1 })}
        />
      );
    }
    if (id === 'row') return t(`cam.row.${row.kind}`, { number: row.index + 1 });
    const name = asPoint(id);
    if (row.kind === 'point') {
      if (name === null) return null;
      const value = name === 'j' ? jerkShown(edit, row.index) : cam.points[row.index]![name];
      const held = heldReason(cam, row.index, name) !== null;
      return <span className={held ? styles.held : undefined}>{value === null ? '' : shortNumber(value)}</span>;
    }
    const segment = cam.segments[row.index]!;
    if (id === 'law') {
      const inflection = segment.law === 'modified_sine' && segment.inflection !== 0.5;
      return `${t(`cam.law.${segment.law}`)}${inflection ? ` (${numberText(segment.inflection)})` : ''}`;
    }
    const curve = drawing?.segments[row.index];
    if (curve === undefined || drawing?.segments.length !== cam.segments.length || name !== null) return null;
    return <span className={styles.held}>{shortNumber(rounded(curve[id as 'least']))}</span>;
  };
  const hint = (at: number, { id }: GridColumn) => {
    const row = rows[at]!;
    const name = asPoint(id);
    if (row.kind !== 'point' || name === null) return undefined;
    const reason = heldReason(cam, row.index, name);
    if (reason !== null) return t(reason);
    const value = cam.points[row.index]![name];
    return shortNumber(value) === numberText(value) ? undefined : numberText(value);
  };
  const onKey = (event: KeyboardEvent): boolean => {
    if (event.key === 'Delete' && !locked && removable(edit)) removed(edit);
    else if (event.key === 'Insert' && !locked) void insertAt(edit, null, 'y', null);
    else return false;
    event.preventDefault();
    return true;
  };

  return (
    <div className={styles.table}>
      <Grid
        label={t('cam.tab.table')}
        columns={columns}
        count={rows.length}
        keyOf={(row) => `${rows[row]?.kind ?? ''}${String(rows[row]?.index)}`}
        cell={cell}
        hint={hint}
        selected={selection.selected}
        cursor={cursor}
        onCursor={(place, how) => {
          selection.move(place, how);
          edit.select(rows[place.row] ?? null);
        }}
        editing={editing}
        editor={(at) => {
          const row = rows[at.row]!;
          const id = columnOf(at.column);
          const name = asPoint(id);
          if (row.kind === 'segment')
            return (
              <LawCell
                law={cam.segments[row.index]!.law}
                onLaw={(law) => {
                  setEditing(null);
                  edit.change(setLaw(cam, row.index, law));
                }}
              />
            );
          if (name === null) return null;
          return (
            <CellInput
              label={t(`cam.column.${name}`)}
              value={numberText(cam.points[row.index]![name])}
              initial={at.initial}
              check={(text) => {
                const fault = pointFault(cam, row.index, name, text);
                return fault === null ? null : t(fault, rangeOf(cam, row.index));
              }}
              onCommit={(text, key, backwards) => {
                setEditing(null);
                if (typedNumber(text) !== cam.points[row.index]![name]) change(row, name, text);
                const by = backwards ? -1 : 1;
                if (key === 'Enter') go(Math.min(at.row + 2, rows.length - 1), at.column);
                if (key === 'Tab') go(at.row, at.column + by);
              }}
              onCancel={() => setEditing(null)}
            />
          );
        }}
        onEdit={(at) => {
          const row = rows[at.row];
          if (row && canEdit(row, columnOf(at.column))) setEditing(at);
        }}
        editOnClick={!locked}
        onKey={onKey}
        onEmptyClick={() => {
          selection.clear();
          edit.select(null);
        }}
        rowState={(row) => (rows[row]?.kind === 'segment' ? 'segment' : undefined)}
      />
    </div>
  );
}

function LawCell({ law, onLaw }: { law: Law; onLaw: (law: Law) => void }) {
  const t = useText();
  return (
    <Select<Law>
      compact
      label={t('cam.column.law')}
      value={law}
      choices={LAWS.map((value) => ({ value, text: t(`cam.law.${value}`) }))}
      onValue={onLaw}
    />
  );
}
