import type { useText } from '@/i18n';
import type { Part } from '@/project/partUri';
import styles from './placeColumns.module.css';
import type { Column } from './table';

interface PlaceRow {
  /** Of the object, with a dot before each name below an object. */
  readonly path: string;
  readonly part: Part;
  /** From 1. */
  readonly line: number;
}

/** The columns of a table of places that say where: object, part, line. */
export function placeColumns<Row extends PlaceRow>(t: ReturnType<typeof useText>): Column<Row>[] {
  return [
    {
      id: 'object',
      title: t('messages.object'),
      width: 240,
      sort: (row) => row.path,
      hint: (row) => row.path,
      cell: (row) => <Path path={row.path} />,
    },
    {
      id: 'part',
      title: t('crossReferences.part'),
      width: 120,
      sort: (row) => row.part,
      cell: (row) => <span>{t(`doc.part.${row.part}`)}</span>,
    },
    {
      id: 'line',
      title: t('crossReferences.line'),
      width: 60,
      align: 'right',
      sort: (row) => row.line,
      cell: (row) => <span className="digits">{row.line}</span>,
    },
  ];
}

/** The name first, what it stands in behind it. */
function Path({ path }: { path: string }) {
  const dot = path.lastIndexOf('.');
  return (
    <span>
      {path.slice(dot + 1)}
      {dot > 0 && <span className={styles.within}> [{path.slice(0, dot)}]</span>}
    </span>
  );
}
