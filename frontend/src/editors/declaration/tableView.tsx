import type { ReactNode } from 'react';
import { RowMark } from '@/bookmarks/RowMark';
import type { t as Text } from '@/i18n';
import type { GridColumn } from '@/ui/grid/Grid';
import styles from './DeclarationTable.module.css';
import type { DeclarationModel } from '@/iec/declaration/model';
import { cellText, columnsFor, DRAFT_KEY, scopeText, type ColumnId, type Draft } from './tableModel';

const LOOK: Readonly<Record<ColumnId, Omit<GridColumn, 'id' | 'title'>>> = {
  number: { width: 48, align: 'right', sortable: true },
  scope: { width: 104, sortable: true },
  name: { width: 150, grow: true, code: true, sortable: true },
  address: { width: 76, code: true, sortable: true },
  type: { width: 150, grow: true, code: true, sortable: true },
  initial: { width: 110, grow: true, code: true, sortable: true },
  comment: { width: 170, grow: true, sortable: true },
  attributes: { width: 94, grow: true, sortable: true },
};

const CODE_CHARACTER_PX = 7.3;

export function tableColumns(t: typeof Text, model: DeclarationModel): readonly GridColumn[] {
  const longest = Math.max(0, ...model.blocks.map((block) => scopeText(block).length));
  const scope = Math.max(LOOK.scope.width, Math.min(220, longest * CODE_CHARACTER_PX + 18));
  return columnsFor(model).map((id) => ({
    id,
    title: t(`decl.column.${id}`),
    ...LOOK[id],
    ...(id === 'scope' && { width: scope }),
  }));
}

interface TableView {
  t: typeof Text;
  model: DeclarationModel;
  draft: Draft | null;
  /** Rows in lines with a bookmark. */
  bookmarked: ReadonlySet<number>;
}

/** How a cell looks while it is not edited. */
export function cellContent({ t, model, draft, bookmarked }: TableView, index: number, column: string): ReactNode {
  if (index === DRAFT_KEY) {
    if (column === 'scope') return <span className={styles.scope}>{draft?.scope}</span>;
    if (column === 'type') return <span className={styles.type}>{draft?.type}</span>;
    return null;
  }
  const row = model.rows[index];
  if (row === undefined) return null;
  if (column === 'number')
    return (
      <>
        {bookmarked.has(index) && <RowMark />}
        <span className={styles.number}>{index + 1}</span>
      </>
    );
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
