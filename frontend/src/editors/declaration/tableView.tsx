import type { ReactNode } from 'react';
import type { t as Text } from '@/i18n';
import type { GridColumn } from '../grid/Grid';
import styles from './DeclarationTable.module.css';
import type { DeclarationModel } from './model';
import { cellText, columnsFor, DRAFT_KEY, type ColumnId, type Draft } from './tableModel';

const LOOK: Readonly<Record<ColumnId, Omit<GridColumn, 'id' | 'title'>>> = {
  number: { width: 40, align: 'right', sortable: true },
  scope: { width: 120, sortable: true },
  name: { width: 170, grow: true, code: true, sortable: true },
  address: { width: 84, code: true, sortable: true },
  type: { width: 170, grow: true, code: true, sortable: true },
  initial: { width: 130, grow: true, code: true, sortable: true },
  comment: { width: 200, grow: true, sortable: true },
  attributes: { width: 120, grow: true, sortable: true },
};

export function tableColumns(t: typeof Text, model: DeclarationModel): readonly GridColumn[] {
  return columnsFor(model).map((id) => ({ id, title: t(`decl.column.${id}`), ...LOOK[id] }));
}

/** How a cell looks while it is not edited. */
export function cellContent(
  t: typeof Text,
  model: DeclarationModel,
  index: number,
  draft: Draft | null,
  column: string,
): ReactNode {
  if (index === DRAFT_KEY) {
    if (column === 'scope') return <span className={styles.scope}>{draft?.scope}</span>;
    if (column === 'type') return <span className={styles.type}>{draft?.type}</span>;
    return null;
  }
  const row = model.rows[index];
  if (row === undefined) return null;
  if (column === 'number') return <span className={styles.number}>{index + 1}</span>;
  const text = cellText(model, row, column);
  if (column === 'scope') return <span className={styles.scope}>{text}</span>;
  if (column === 'type') return <span className={styles.type}>{text}</span>;
  if (column === 'comment' || column === 'attributes') {
    const lines = text.split('\n');
    const more = lines.length > 1 ? ` ${t('decl.moreLines', { count: lines.length - 1 })}` : '';
    return (
      <span className={styles.muted}>
        {lines[0]}
        {more}
      </span>
    );
  }
  return <span>{text}</span>;
}
