import { RotateCcw, SlidersHorizontal, TriangleAlert } from 'lucide-react';
import { useRef, useState } from 'react';
import type { LibraryReference, LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { useContents } from '@/workbench/libraries/useLibraries';
import { IconButton } from '@/ui/Button';
import { Empty, Loading } from '@/ui/Empty';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import styles from './LibraryManager.module.css';
import { librariesInUse, parameterRows, withValue, type ParameterRow } from './parameters';

interface LibraryParametersProps {
  references: readonly LibraryReference[];
  installed: readonly LibrarySummary[];
  readOnly: string | null;
  change: (at: number, reference: LibraryReference) => void;
}

/** The parameters of the libraries in use; a value typed here holds in place of the library's own. */
export function LibraryParameters({ references, installed, readOnly, change }: LibraryParametersProps) {
  const t = useText();
  const [selected, setSelected] = useState<string | null>(null);
  const table = useRef<HTMLDivElement>(null);
  const libraries = librariesInUse(references, installed);
  const contents = useContents(libraries);
  const rows = parameterRows(references, installed, contents);
  const chosen = rows.find((row) => row.key === selected) ?? rows[0];
  if (rows.length === 0 && contents.size < libraries.length) return <Loading />;

  const give = (row: ParameterRow, value: string | null) => {
    if (readOnly === null && value !== row.value) change(row.at, withValue(references[row.at]!, row, value));
  };
  const type = (row: ParameterRow) => {
    const inputs = [...(table.current?.querySelectorAll<HTMLInputElement>('input[data-parameter]') ?? [])];
    inputs.find((input) => input.dataset.parameter === row.key)?.select();
  };
  const columns: Column<ParameterRow>[] = [
    { id: 'library', title: t('libraryParameters.library'), width: 130, cell: (row) => <span>{row.library}</span> },
    {
      id: 'list',
      title: t('libraryParameters.list'),
      width: 150,
      cell: (row) => <span className="code">{row.list}</span>,
    },
    {
      id: 'name',
      title: t('libraryParameters.parameter'),
      width: 260,
      cell: (row) => <NameCell row={row} />,
      hint: (row) => (row.known === false ? t('libraryParameters.unknown') : row.name),
    },
    {
      id: 'type',
      title: t('libraryParameters.type'),
      width: 110,
      cell: (row) => <span className="code">{row.type}</span>,
    },
    {
      id: 'default',
      title: t('libraryParameters.default'),
      width: 130,
      cell: (row) => <span className={`code ${styles.along}`}>{row.default}</span>,
      hint: (row) => row.default,
    },
    {
      id: 'value',
      title: t('libraryParameters.value'),
      width: 190,
      cell: (row) => (
        <ValueCell key={row.value ?? ''} row={row} readOnly={readOnly} give={(value) => give(row, value)} />
      ),
    },
    {
      id: 'comment',
      title: t('libraryParameters.comment'),
      width: 140,
      grow: true,
      cell: (row) => <span className={styles.along}>{row.comment}</span>,
      hint: (row) => row.comment,
    },
  ];
  return (
    <div ref={table} className={styles.parameters}>
      <Table
        label={t('libraryParameters.title')}
        items={rows}
        columns={columns}
        keyOf={(row) => row.key}
        selected={chosen?.key ?? null}
        onSelect={(row) => setSelected(row?.key ?? null)}
        onOpen={type}
        onKey={(event, row) => {
          if (!row) return;
          if (event.key === 'Delete') give(row, null);
          if (event.key === 'F2') {
            event.preventDefault();
            type(row);
          }
        }}
        empty={
          <Empty icon={SlidersHorizontal} title={t('libraryParameters.none')} text={t('libraryParameters.noneText')} />
        }
      />
    </div>
  );
}

function NameCell({ row }: { row: ParameterRow }) {
  const t = useText();
  if (row.known !== false) return <span className="code">{row.name}</span>;
  return (
    <>
      <TriangleAlert size={15} className={styles.missing} aria-label={t('libraryParameters.unknown')} />
      <span className={`code ${styles.missing}`}>{row.name}</span>
    </>
  );
}

interface ValueCellProps {
  row: ParameterRow;
  readOnly: string | null;
  give: (value: string | null) => void;
}

/** The value, to be typed; empty takes the library's own again. Enter and Escape go back to the table. */
function ValueCell({ row, readOnly, give }: ValueCellProps) {
  const t = useText();
  const [text, setText] = useState(row.value ?? '');
  const left = useRef(false);
  const name = row.list ? `${row.list}.${row.name}` : row.name;
  return (
    <>
      <input
        className={`code ${styles.inCell} ${row.value === null ? '' : styles.given}`}
        data-parameter={row.key}
        value={text}
        placeholder={row.default}
        readOnly={readOnly !== null || row.known !== true}
        spellCheck={false}
        maxLength={4000}
        aria-label={t('libraryParameters.valueOf', { name })}
        onChange={(event) => setText(event.target.value)}
        onBlur={() => {
          if (left.current) setText(row.value ?? '');
          else give(text.trim() || null);
          left.current = false;
        }}
        onKeyDown={(event) => {
          event.stopPropagation();
          if (event.key !== 'Enter' && event.key !== 'Escape') return;
          event.preventDefault();
          left.current = event.key === 'Escape';
          event.currentTarget.closest<HTMLElement>('[role="grid"]')?.focus();
        }}
        onDoubleClick={(event) => event.stopPropagation()}
      />
      {row.value !== null && (
        <IconButton
          small
          icon={RotateCcw}
          label={t('libraryParameters.reset', { name })}
          shortcut="Del"
          disabledReason={readOnly}
          onClick={() => give(null)}
        />
      )}
    </>
  );
}
