import { TriangleAlert } from 'lucide-react';
import { useState } from 'react';
import type { LibraryReference, LibrarySummary } from '@/api/types';
import { t } from '@/i18n';
import { objectIcon } from '@/project/kinds';
import { Select } from '@/ui/Field';
import type { Column } from '@/ui/table';
import { Twist } from '@/ui/Twist';
import styles from './LibraryManager.module.css';
import { isQualifiedOnly, namespaceFault, namespaceOf, type ReferenceRow } from './model';
import { versionChoices } from './ReferenceFields';

const Icon = objectIcon('library_manager');

interface ColumnOptions {
  references: readonly LibraryReference[];
  installed: readonly LibrarySummary[];
  open: ReadonlySet<string>;
  readOnly: boolean;
  toggle: (key: string) => void;
  change: (at: number, reference: LibraryReference) => void;
}

/** Name, namespace, version and effective version; the namespace and the version of a reference can be changed. */
export function referenceColumns(options: ColumnOptions): Column<ReferenceRow>[] {
  const { references, installed, open, readOnly, toggle, change } = options;
  return [
    {
      id: 'name',
      title: t('library.name'),
      width: 240,
      grow: true,
      cell: (row) => (
        <>
          <span style={{ width: (row.level - 1) * 16, flex: 'none' }} />
          <Twist
            open={open.has(row.key)}
            expandable={row.expandable}
            role={row.expandable ? 'button' : undefined}
            aria-label={row.expandable ? t('libraries.requiredBy', { name: row.name }) : undefined}
            onPointerDown={(event) => {
              event.stopPropagation();
              if (row.expandable) toggle(row.key);
            }}
          />
          {row.library ? (
            <Icon size={15} />
          ) : (
            <TriangleAlert size={15} className={styles.missing} aria-label={t('library.missing')} />
          )}
          <span className={row.library ? (row.at === null ? styles.along : undefined) : styles.missing}>
            {nameText(row)}
          </span>
        </>
      ),
      hint: (row) => (row.library ? row.library.description : t('library.missing')),
    },
    {
      id: 'namespace',
      title: t('library.namespace'),
      width: 180,
      cell: (row) =>
        row.reference && row.at !== null ? (
          <NamespaceCell
            key={namespaceOf(row.reference, installed)}
            reference={row.reference}
            at={row.at}
            references={references}
            installed={installed}
            readOnly={readOnly}
            change={change}
          />
        ) : (
          <span className="code">{row.library?.namespace ?? ''}</span>
        ),
    },
    {
      id: 'qualifiedOnly',
      title: t('library.access'),
      width: 110,
      cell: (row) => (isQualifiedOnly(row) ? <span>{t('library.accessQualified')}</span> : null),
      hint: (row) => (isQualifiedOnly(row) ? t('library.qualifiedOnlyHint') : t('library.accessFree')),
    },
    {
      id: 'version',
      title: t('library.version'),
      width: 130,
      cell: (row) => {
        const { reference, at } = row;
        if (!reference || at === null || readOnly)
          return <span>{row.version === '*' ? t('library.newest') : row.version}</span>;
        return (
          <Select
            compact
            label={t('libraries.versionOf', { name: row.name })}
            value={reference.version}
            choices={versionChoices(reference, installed, t('library.newest'))}
            onValue={(version) => change(at, { ...reference, version })}
          />
        );
      },
    },
    {
      id: 'effective',
      title: t('library.effective'),
      width: 130,
      cell: (row) => <span className="digits">{row.library?.version ?? '–'}</span>,
    },
  ];
}

function nameText({ name, library, reference }: ReferenceRow): string {
  const company = library?.company ? ` (${library.company})` : '';
  if (reference?.placeholder) return t('libraries.resolved', { placeholder: reference.placeholder, name });
  return `${name}${company}`;
}

interface NamespaceCellProps {
  reference: LibraryReference;
  at: number;
  references: readonly LibraryReference[];
  installed: readonly LibrarySummary[];
  readOnly: boolean;
  change: (at: number, reference: LibraryReference) => void;
}

/** The namespace, to be typed over; empty takes that of the library again. */
function NamespaceCell({ reference, at, references, installed, readOnly, change }: NamespaceCellProps) {
  const now = namespaceOf(reference, installed);
  const [text, setText] = useState(now);
  const edited = {
    ...reference,
    namespace: text === namespaceOf({ ...reference, namespace: '' }, installed) ? '' : text,
  };
  const fault = namespaceFault(edited, at, references, installed);
  const take = () => {
    if (fault) setText(now);
    else if (edited.namespace !== reference.namespace) change(at, edited);
  };
  return (
    <input
      className={`code ${styles.inCell}`}
      value={text}
      readOnly={readOnly}
      spellCheck={false}
      aria-label={t('libraries.namespaceOf', { name: reference.name })}
      aria-invalid={fault ? true : undefined}
      title={fault ? t(fault) : undefined}
      onChange={(event) => setText(event.target.value)}
      onBlur={take}
      onKeyDown={(event) => {
        event.stopPropagation();
        if (event.key === 'Enter') take();
        if (event.key === 'Escape') setText(now);
      }}
      onDoubleClick={(event) => event.stopPropagation()}
    />
  );
}
