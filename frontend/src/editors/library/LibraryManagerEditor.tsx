import { Library as LibraryIcon, Pencil, Plus, Trash2, TriangleAlert } from 'lucide-react';
import { useMemo, useState } from 'react';
import type { LibraryItem, LibraryManagerData, LibraryReference } from '@/api/types';
import { useText } from '@/i18n';
import { objectIcon } from '@/icons/objects';
import { openDialog } from '@/workbench/dialogs';
import type { EditorProps } from '@/workbench/editors';
import { ItemDoc } from '@/workbench/libraries/ItemDoc';
import { LibraryTree } from '@/workbench/libraries/LibraryTree';
import { useLibraries } from '@/workbench/libraries/useLibraries';
import { Button, IconButton } from '@/workbench/ui/Button';
import { Empty, Failed, Loading } from '@/workbench/ui/Empty';
import { Table } from '@/workbench/ui/Table';
import type { Column } from '@/workbench/ui/table';
import { useDraft } from '../form/useDraft';
import { AddLibraryDialog } from './AddLibraryDialog';
import { LibraryPropertiesDialog } from './LibraryPropertiesDialog';
import styles from './LibraryManager.module.css';
import { addable, effectiveVersion, namespaceOf } from './model';

const Icon = objectIcon('library_manager');

/** Above the libraries in use, below the contents of the chosen one with documentation (LIB-01 to LIB-09). */
export default function LibraryManagerEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const draft = useDraft<LibraryManagerData>(panelId, projectId, objectId, () => true);
  const installed = useLibraries();
  const [selected, setSelected] = useState<string | null>(null);
  const [shown, setShown] = useState<{ library: string; item: LibraryItem | null } | null>(null);
  const libraries = useMemo(() => installed.data ?? [], [installed.data]);
  const references = useMemo(() => draft.data?.references ?? [], [draft.data]);
  const at = references.findIndex((reference) => reference.name === selected);
  const chosen = references[at] ?? references[0];
  const summary = libraries.find((library) => library.name === chosen?.name);

  const columns = useMemo(
    (): Column<LibraryReference>[] => [
      {
        id: 'name',
        title: t('library.name'),
        width: 220,
        grow: true,
        sort: (reference) => reference.name,
        cell: (reference) => {
          const library = libraries.find((one) => one.name === reference.name);
          const missing = effectiveVersion(reference, libraries) === null;
          return (
            <>
              {missing ? (
                <TriangleAlert size={15} className={styles.missing} aria-label={t('library.missing')} />
              ) : (
                <Icon size={15} />
              )}
              <span className={missing ? styles.missing : undefined}>
                {reference.name}
                {library?.company ? ` (${library.company})` : ''}
              </span>
            </>
          );
        },
        hint: (reference) =>
          effectiveVersion(reference, libraries) === null
            ? t('library.missing')
            : (libraries.find((one) => one.name === reference.name)?.description ?? ''),
      },
      {
        id: 'namespace',
        title: t('library.namespace'),
        width: 180,
        sort: (reference) => namespaceOf(reference, libraries),
        cell: (reference) => <span className="code">{namespaceOf(reference, libraries)}</span>,
      },
      {
        id: 'version',
        title: t('library.version'),
        width: 120,
        cell: (reference) => <span>{reference.version === '*' ? t('library.newest') : reference.version}</span>,
      },
      {
        id: 'effective',
        title: t('library.effective'),
        width: 130,
        cell: (reference) => <span className="digits">{effectiveVersion(reference, libraries) ?? '–'}</span>,
      },
    ],
    [t, libraries],
  );

  if (draft.error && !draft.object) return <Failed error={draft.error} />;
  if (installed.isError) return <Failed error={installed.error} retry={() => void installed.refetch()} />;
  if (!draft.data || !installed.data) return <Loading />;

  const change = (next: LibraryReference[]) => draft.change({ references: next });
  const add = async () => {
    const names = await openDialog<string[]>((close) => (
      <AddLibraryDialog libraries={addable(references, libraries)} close={close} />
    ));
    if (names?.length) {
      change([...references, ...names.map((name) => ({ name, version: '*', namespace: '' }))]);
      setSelected(names[0]!);
    }
  };
  const edit = async () => {
    if (!chosen) return;
    const index = references.indexOf(chosen);
    const edited = await openDialog<LibraryReference>((close) => (
      <LibraryPropertiesDialog
        reference={chosen}
        at={index}
        references={references}
        installed={libraries}
        close={close}
      />
    ));
    if (edited) change(references.map((reference, place) => (place === index ? edited : reference)));
  };
  const remove = () => change(references.filter((reference) => reference !== chosen));
  const none = chosen ? null : t('library.chooseOne');

  return (
    <div className={styles.view}>
      <div className={styles.upper}>
        <div className={styles.bar}>
          <Button
            variant="quiet"
            icon={Plus}
            disabledReason={draft.readOnly ?? (addable(references, libraries).length ? null : t('library.allAdded'))}
            onClick={() => void add()}
          >
            {t('library.add')}
          </Button>
          <IconButton
            icon={Pencil}
            label={t('library.properties')}
            disabledReason={draft.readOnly ?? none}
            onClick={() => void edit()}
          />
          <IconButton
            icon={Trash2}
            label={t('library.remove')}
            shortcut="Del"
            disabledReason={draft.readOnly ?? none}
            onClick={remove}
          />
        </div>
        <div className={styles.table}>
          <Table
            label={t('library.references')}
            items={references}
            columns={columns}
            keyOf={(reference) => reference.name}
            selected={chosen?.name ?? null}
            onSelect={(reference) => setSelected(reference?.name ?? null)}
            onOpen={() => !draft.readOnly && void edit()}
            onKey={(event) => {
              if (event.key === 'Delete' && chosen && !draft.readOnly) remove();
              if (event.key === 'Insert' && !draft.readOnly) void add();
            }}
            empty={<Empty icon={LibraryIcon} title={t('library.none')} text={t('library.noneText')} />}
          />
        </div>
      </div>
      <div className={styles.lower}>
        <div className={styles.contents}>
          {summary ? (
            <LibraryTree
              key={summary.name}
              label={t('library.contents', { name: summary.name })}
              libraries={[summary]}
              flat
              onChoose={(library, item) => setShown({ library, item })}
            />
          ) : (
            <Empty
              title={chosen ? t('library.missing') : t('library.chooseOne')}
              text={chosen ? t('library.missingText', { name: chosen.name }) : undefined}
            />
          )}
        </div>
        <ItemDoc library={shown?.library ?? null} item={shown && shown.library === summary?.name ? shown.item : null} />
      </div>
    </div>
  );
}
