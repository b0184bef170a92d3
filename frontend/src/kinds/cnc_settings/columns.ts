/** The columns of the tables of an application's CNC programs (CNCS-11). */
import { useQuery } from '@tanstack/react-query';
import { useMemo } from 'react';
import { ofKind, shaped } from '@/api/objects';
import { objectQuery, useObjects } from '@/api/queries';
import type { DataOfKind } from '@/api/types';
import { applicationOf } from '@/project/tree';

export type TableColumns = DataOfKind['cnc_settings']['columns'];
export type ColumnName = TableColumns[number]['name'];

const isSettings = ofKind('cnc_settings');
/** Of programs that came without settings. */
const USUAL: readonly ColumnName[] = [
  'n',
  'x',
  'y',
  'z',
  'i',
  'j',
  'k',
  'r',
  'f',
  'acceleration',
  'deceleration',
  'd',
  'p',
  'comment',
];

/** The visible columns for a program, in their order. */
export function useColumns(projectId: string, objectId: string): readonly ColumnName[] {
  const { data: objects } = useObjects(projectId);
  const application = objects && applicationOf(objects, objectId);
  const settings = objects?.find(({ kind, parent_id }) => kind === 'cnc_settings' && parent_id === application?.id);
  const { data } = useQuery({
    ...objectQuery(projectId, settings?.id ?? ''),
    select: (object) => shaped(object, isSettings),
    enabled: settings !== undefined,
  });
  return useMemo(() => data?.data.columns.filter(({ visible }) => visible).map(({ name }) => name) ?? USUAL, [data]);
}

/** A list, such as that of the columns, with one of its rows at another place; null where it cannot go there. */
export function movedColumn<Row>(columns: readonly Row[], from: number, to: number): Row[] | null {
  if (from < 0 || from >= columns.length || to < 0 || to >= columns.length || from === to) return null;
  const next = [...columns];
  next.splice(to, 0, ...next.splice(from, 1));
  return next;
}

/** The columns with some of them shown, or hidden if all of these were shown. */
export function toggledColumns(columns: TableColumns, chosen: ReadonlySet<number>): TableColumns {
  const shown = columns.every(({ visible }, at) => visible || !chosen.has(at));
  return columns.map((column, at) => (chosen.has(at) ? { ...column, visible: !shown } : column));
}
