import type { t as Text } from '@/i18n';
import type { GridColumn } from '@/ui/grid/Grid';

/** The columns of a list of expressions with their values. */
export function onlineColumns(t: typeof Text): readonly GridColumn[] {
  return [
    { id: 'expression', title: t('online.column.expression'), width: 260, grow: true },
    { id: 'type', title: t('online.column.type'), width: 170 },
    { id: 'value', title: t('online.column.value'), width: 150, grow: true },
    { id: 'prepared', title: t('online.column.prepared'), width: 130 },
    { id: 'comment', title: t('online.column.comment'), width: 180, grow: true },
  ];
}
