import { Minus, Plus } from 'lucide-react';
import { useMemo, useState, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import { numberText, typedNumber } from '@/editors/form/numbers';
import { IconButton } from '@/ui/Button';
import { Select } from '@/ui/Field';
import { CellInput } from '@/ui/grid/CellInput';
import { Grid, type GridColumn, type GridEditing } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import type { TappetAction } from './camTable';
import styles from './Cam.module.css';
import type { CamEdit } from './edit';
import { domainTexts, tappetFault } from './properties';
import { tappetRows, type TappetRow } from './rows';
import {
  ACTIONS,
  addTappet,
  addTrack,
  deleteTappet,
  isTrackId,
  mayBeTrackId,
  moveToTrack,
  setTappet,
  setTrackId,
  tappetOf,
} from './tappets';

/** Tracks with their tappets as rows (CAM-55 to CAM-59). */
export function TappetGrid({ edit }: { edit: CamEdit }) {
  const t = useText();
  const { cam, locked } = edit;
  const rows = useMemo(() => tappetRows(cam), [cam]);
  const selection = useGridSelection(rows.length);
  const [editing, setEditing] = useState<GridEditing | null>(null);
  const columns = useMemo(
    (): GridColumn[] => [
      { id: 'act', title: '', width: 34 },
      { id: 'track', title: t('cam.column.track'), width: 110, align: 'right', code: true },
      { id: 'x', title: t('cam.column.x'), width: 130, align: 'right', code: true },
      { id: 'positive', title: t('cam.column.positive'), width: 170 },
      { id: 'negative', title: t('cam.column.negative'), width: 170 },
    ],
    [t],
  );
  const columnOf = (at: number) => columns[at]?.id ?? '';
  const canEdit = (row: TappetRow, id: string) =>
    !locked && id !== 'act' && (row.kind === 'tappet' || (row.kind === 'track' && id === 'track'));
  const remove = (row: TappetRow | undefined) => {
    if (row?.kind === 'tappet' && !locked) edit.change(deleteTappet(cam, row), null);
  };
  const add = (row: TappetRow) => {
    const added = row.kind === 'track' ? addTappet(cam, row.track, 0) : addTrack(cam);
    edit.change(added.cam, { kind: 'tappet', ...added.place });
  };
  const cell = (at: number, { id }: GridColumn) => {
    const row = rows[at]!;
    if (id === 'act')
      return (
        <IconButton
          small
          icon={row.kind === 'tappet' ? Minus : Plus}
          label={t(
            row.kind === 'tappet' ? 'cam.deleteTappet' : row.kind === 'track' ? 'cam.addTappet' : 'cam.addTrack',
          )}
          disabledReason={locked ? t('cam.locked') : null}
          onClick={() => (row.kind === 'tappet' ? remove(row) : add(row))}
        />
      );
    if (row.kind === 'add') return id === 'track' ? <span className={styles.held}>{t('cam.addTrack')}</span> : null;
    if (id === 'track') return String(cam.tracks[row.track]!.id);
    const tappet = row.kind === 'tappet' ? tappetOf(cam, row) : undefined;
    if (!tappet) return null;
    return id === 'x' ? numberText(tappet.x) : t(`cam.action.${tappet[id as 'positive']}`);
  };
  const check = (row: TappetRow, id: string, text: string): string | null => {
    if (id === 'x') {
      const fault = tappetFault(cam, text);
      return fault === null ? null : t(fault, domainTexts(cam));
    }
    const number = typedNumber(text);
    if (!isTrackId(number)) return t('cam.fault.track');
    return row.kind === 'track' && !mayBeTrackId(cam, row.track, number) ? t('cam.fault.trackTaken') : null;
  };
  const commit = (row: TappetRow, id: string, text: string) => {
    const number = typedNumber(text);
    if (row.kind === 'track') edit.change(setTrackId(cam, row.track, number));
    else if (row.kind === 'tappet') {
      const moved = id === 'x' ? setTappet(cam, row, { x: number }) : moveToTrack(cam, row, number);
      edit.change(moved.cam, { kind: 'tappet', ...moved.place });
    }
  };
  const onKey = (event: KeyboardEvent): boolean => {
    const row = selection.cursor === null ? undefined : rows[selection.cursor.row];
    if (row === undefined || locked) return false;
    if (event.key === 'Delete') remove(row);
    else if (event.key === 'Insert') add(row.kind === 'tappet' ? { kind: 'track', track: row.track } : row);
    else return false;
    event.preventDefault();
    return true;
  };
  return (
    <div className={styles.table}>
      <Grid
        label={t('cam.tab.tappetTable')}
        columns={columns}
        count={rows.length}
        keyOf={(at) => {
          const row = rows[at];
          return row?.kind === 'tappet'
            ? `${String(row.track)}.${String(row.index)}`
            : `${String(at)}${row?.kind ?? ''}`;
        }}
        cell={cell}
        selected={selection.selected}
        cursor={selection.cursor}
        onCursor={(place, how) => {
          selection.move(place, how);
          const row = rows[place.row];
          edit.select(row?.kind === 'tappet' ? row : null);
        }}
        editing={editing}
        editor={(at) => {
          const row = rows[at.row]!;
          const id = columnOf(at.column);
          const tappet = row.kind === 'tappet' ? tappetOf(cam, row) : undefined;
          if (id === 'positive' || id === 'negative')
            return tappet && row.kind === 'tappet' ? (
              <Select<TappetAction>
                compact
                label={t(`cam.column.${id}`)}
                value={tappet[id]}
                choices={ACTIONS.map((value) => ({ value, text: t(`cam.action.${value}`) }))}
                onValue={(value) => {
                  setEditing(null);
                  edit.change(setTappet(cam, row, { [id]: value }).cam);
                }}
              />
            ) : null;
          if (row.kind === 'add') return null;
          const value = id === 'x' ? numberText(tappet?.x ?? 0) : String(cam.tracks[row.track]!.id);
          return (
            <CellInput
              label={t(`cam.column.${id as 'x'}`)}
              value={value}
              initial={at.initial}
              check={(text) => check(row, id, text)}
              onCommit={(text) => {
                setEditing(null);
                if (text !== value) commit(row, id, text);
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
        rowState={(at) => (rows[at]?.kind === 'tappet' ? undefined : 'segment')}
      />
    </div>
  );
}
