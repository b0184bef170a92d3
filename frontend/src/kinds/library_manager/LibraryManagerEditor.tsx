import { Library as LibraryIcon, LibraryBig, Pencil, Plus, Trash2 } from 'lucide-react';
import { useMemo, useState } from 'react';
import { ofKind } from '@/api/objects';
import type { LibraryItem, LibraryReference } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import type { EditorProps } from '@/project/editorProps';
import { ItemDoc } from '@/workbench/libraries/ItemDoc';
import { LibraryTree } from '@/workbench/libraries/LibraryTree';
import { idOf } from '@/workbench/libraries/model';
import { useLibraries } from '@/workbench/libraries/useLibraries';
import { runCommand } from '@/workbench/run';
import { useToggleSet } from '@/ui/toggleSet';
import { Button, IconButton } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Table } from '@/ui/Table';
import { Tabs } from '@/ui/Tabs';
import { useDraft } from '@/editors/form/useDraft';
import { AddLibraryDialog } from './AddLibraryDialog';
import { referenceColumns } from './columns';
import { LibraryParameters } from './LibraryParameters';
import { LibraryPropertiesDialog } from './LibraryPropertiesDialog';
import styles from './LibraryManager.module.css';
import { keyOf, rowsOf } from './model';

/**
 * Above the libraries in use, below the contents of the chosen one with documentation (LIB-01 to LIB-09), or the
 * parameters of all.
 */
export default function LibraryManagerEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('library_manager'), () => true);
  const installed = useLibraries();
  const [selected, setSelected] = useState<string | null>(null);
  const [open, toggle] = useToggleSet<string>();
  const [shown, setShown] = useState<{ library: string; item: LibraryItem | null } | null>(null);
  const libraries = useMemo(() => installed.data ?? [], [installed.data]);
  const references = useMemo(() => draft.data?.references ?? [], [draft.data]);
  const rows = useMemo(() => rowsOf(references, libraries, open), [references, libraries, open]);
  const chosen = rows.find((row) => row.key === selected) ?? rows[0];
  const readOnly = draft.readOnly !== null;

  if (draft.error && !draft.object) return <Failed error={draft.error} />;
  if (installed.isError) return <Failed error={installed.error} retry={() => void installed.refetch()} />;
  if (!draft.data || !installed.data) return <Loading />;

  const change = (next: LibraryReference[]) => draft.change({ references: next });
  const changeAt = (at: number, edited: LibraryReference) => {
    change(references.map((reference, place) => (place === at ? edited : reference)));
    setSelected(keyOf(edited, libraries));
  };
  const add = async () => {
    const added = await openDialog<LibraryReference>((close) => (
      <AddLibraryDialog references={references} installed={libraries} close={close} />
    ));
    if (!added) return;
    change([...references, added]);
    setSelected(keyOf(added, libraries));
  };
  const edit = async () => {
    const at = chosen?.at ?? null;
    if (at === null) return;
    const edited = await openDialog<LibraryReference>((close) => (
      <LibraryPropertiesDialog
        reference={references[at]!}
        at={at}
        references={references}
        installed={libraries}
        close={close}
      />
    ));
    if (edited) changeAt(at, edited);
  };
  const remove = () => change(references.filter((_, at) => at !== chosen?.at));
  const none = !chosen ? t('library.chooseOne') : chosen.at === null ? t('libraries.comesAlong') : null;
  const library = chosen?.library ?? null;
  const columns = referenceColumns({
    references,
    installed: libraries,
    open,
    readOnly,
    toggle,
    change: changeAt,
  });

  const contents = (
    <div className={styles.halves}>
      <div className={styles.contents}>
        {library ? (
          <LibraryTree
            key={idOf(library)}
            label={t('library.contents', { name: library.name })}
            libraries={[library]}
            flat
            onChoose={(from, item) => setShown({ library: idOf(from), item })}
          />
        ) : (
          <Empty
            title={chosen ? t('library.missing') : t('library.chooseOne')}
            text={chosen ? t('library.missingText', { name: chosen.name }) : undefined}
          />
        )}
      </div>
      <ItemDoc
        library={library && `${library.name}, ${library.version}`}
        item={shown && library && shown.library === idOf(library) ? shown.item : null}
      />
    </div>
  );

  return (
    <div className={styles.view}>
      <div className={styles.upper}>
        <div className={styles.bar}>
          <Button variant="quiet" icon={Plus} disabledReason={draft.readOnly} onClick={() => void add()}>
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
          <IconButton
            icon={LibraryBig}
            label={t('command.libraryRepository')}
            onClick={() => void runCommand('tools.libraryRepository')}
          />
        </div>
        <div className={styles.table}>
          <Table
            label={t('library.references')}
            items={rows}
            columns={columns}
            keyOf={(row) => row.key}
            selected={chosen?.key ?? null}
            onSelect={(row) => setSelected(row?.key ?? null)}
            onOpen={() => !readOnly && void edit()}
            onKey={(event) => {
              if (event.key === 'Delete' && chosen?.at != null && !readOnly) remove();
              if (event.key === 'Insert' && !readOnly) void add();
              if (event.key === 'ArrowRight' && chosen?.expandable && !open.has(chosen.key)) toggle(chosen.key);
              if (event.key === 'ArrowLeft' && chosen && open.has(chosen.key)) toggle(chosen.key);
            }}
            empty={<Empty icon={LibraryIcon} title={t('library.none')} text={t('library.noneText')} />}
          />
        </div>
      </div>
      <div className={styles.lower}>
        <Tabs
          pages={[
            { id: 'contents', title: t('library.contentsTab'), content: contents },
            {
              id: 'parameters',
              title: t('libraryParameters.title'),
              content: (
                <LibraryParameters
                  references={references}
                  installed={libraries}
                  readOnly={draft.readOnly}
                  change={(at, edited) => change(references.map((one, place) => (place === at ? edited : one)))}
                />
              ),
            },
          ]}
        />
      </div>
    </div>
  );
}
