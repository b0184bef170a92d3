import { Download, PackagePlus, Trash2 } from 'lucide-react';
import { useRef, useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { LibrarySummary } from '@/api/types';
import { listed, useText } from '@/i18n';
import { confirm } from '@/ui/dialogs';
import { saveBlob } from '../downloadFile';
import { guard, notify } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { descriptionColumn, nameColumn } from './columns';
import styles from './Libraries.module.css';
import { idOf } from './model';
import { useLibraries } from './useLibraries';

const at = ({ name, version }: LibrarySummary) => ({ params: { path: { name, version } } });

async function saveFile(library: LibrarySummary): Promise<void> {
  saveBlob(await api.download('/api/v1/libraries/{name}/{version}/file', at(library)), `${idOf(library)}.tappetlib`);
}

/** All installed libraries: installing a file, saving one as a file, uninstalling a version (LIB-08). */
export function RepositoryDialog({ readOnly, close }: { readOnly: string | null; close: () => void }) {
  const t = useText();
  const installed = useLibraries();
  const [selected, setSelected] = useState<string | null>(null);
  const file = useRef<HTMLInputElement>(null);
  const libraries = installed.data ?? [];
  const chosen = libraries.find((library) => idOf(library) === selected) ?? null;

  const install = async (files: readonly File[]) => {
    for (const one of files) {
      const added = await guard(() => api.post('/api/v1/libraries', { body: { file: one } }));
      if (!added) continue;
      await queryClient.invalidateQueries({ queryKey: keys.libraries });
      setSelected(idOf(added));
      notify({ tone: 'ok', title: t('libraries.installed', { name: idOf(added) }) });
    }
  };
  const uninstall = async (library: LibrarySummary) => {
    const uses = await guard(() => api.get('/api/v1/libraries/{name}/{version}/projects', at(library)));
    if (!uses) return;
    const projects = [...new Set(uses.map((use) => use.project_name))];
    const sure = await confirm({
      title: t('libraries.uninstallTitle', { name: idOf(library) }),
      text: projects.length
        ? t('libraries.uninstallUsed', { projects: listed(projects) })
        : t('libraries.uninstallText'),
      action: t('libraries.uninstall'),
      danger: true,
    });
    if (!sure) return;
    await guard(() => api.delete('/api/v1/libraries/{name}/{version}', at(library)));
    await queryClient.invalidateQueries({ queryKey: keys.libraries });
  };

  const columns: Column<LibrarySummary>[] = [
    nameColumn(t),
    {
      id: 'version',
      title: t('library.version'),
      width: 90,
      sort: (one) => one.version,
      cell: (one) => <span className="digits">{one.version}</span>,
    },
    {
      id: 'company',
      title: t('libraries.company'),
      width: 110,
      sort: (one) => one.company,
      cell: (one) => <span>{one.company}</span>,
    },
    {
      id: 'requires',
      title: t('libraries.requires'),
      width: 130,
      cell: (one) => <span>{listed(one.requires.map((required) => required.name))}</span>,
      hint: (one) => listed(one.requires.map((required) => `${required.name} ${required.version}`)),
    },
    descriptionColumn(t, 180),
  ];
  return (
    <Dialog
      title={t('command.libraryRepository')}
      width={1000}
      onClose={close}
      footer={
        <>
          <input
            ref={file}
            type="file"
            accept=".tappetlib"
            multiple
            hidden
            aria-label={t('libraries.install')}
            onChange={(event) => {
              const files = [...(event.target.files ?? [])];
              event.target.value = '';
              void install(files);
            }}
          />
          <Button icon={PackagePlus} disabledReason={readOnly} onClick={() => file.current?.click()}>
            {t('libraries.install')}
          </Button>
          <Button
            icon={Download}
            disabledReason={chosen ? null : t('library.chooseOne')}
            onClick={() => chosen && void guard(() => saveFile(chosen))}
          >
            {t('libraries.saveFile')}
          </Button>
          <Button
            icon={Trash2}
            disabledReason={
              readOnly ?? (chosen ? (chosen.removable ? null : t('libraries.stays')) : t('library.chooseOne'))
            }
            onClick={() => chosen && void uninstall(chosen)}
          >
            {t('libraries.uninstall')}
          </Button>
          <span className={styles.spacer} />
          <Button onClick={close}>{t('action.close')}</Button>
        </>
      }
    >
      <div
        className={styles.repository}
        onDragOver={(event) => event.preventDefault()}
        onDrop={(event) => {
          event.preventDefault();
          if (!readOnly) void install([...event.dataTransfer.files]);
        }}
      >
        {installed.isError ? (
          <Failed error={installed.error} retry={() => void installed.refetch()} />
        ) : !installed.data ? (
          <Loading />
        ) : (
          <Table
            label={t('command.libraryRepository')}
            items={libraries}
            columns={columns}
            keyOf={idOf}
            selected={selected}
            onSelect={(library) => setSelected(library ? idOf(library) : null)}
            empty={<Empty title={t('libraries.none')} />}
          />
        )}
      </div>
    </Dialog>
  );
}
