import { useQuery } from '@tanstack/react-query';
import { Boxes, Cog, Download, Ellipsis, FileUp, FilePlus, FolderOpen, Trash2 } from 'lucide-react';
import { useEffect, useState, type DragEvent } from 'react';
import { api } from '@/api/client';
import { examplesQuery, keys, projectsQuery, queryClient } from '@/api/queries';
import type { Example, ProjectSummary } from '@/api/types';
import { useLanguage, useText } from '@/i18n';
import { secondText } from '@/workbench/clock';
import { kindWithRole } from '@/project/kinds';
import { ObjectIcon } from '@/project/ObjectIcon';
import { TappetMark } from '@/icons/TappetMark';
import { confirm, openDialog } from '@/ui/dialogs';
import { saveBlob } from '@/workbench/downloadFile';
import { UserMenu } from '@/workbench/frame/UserMenu';
import { droppedFiles, type NamedFile } from '@/workbench/exchange/dropped';
import { exampleText } from '@/workbench/projectInfo/exampleText';
import { guard } from '@/ui/notices';
import { atLeast } from '@/workbench/rights';
import { Button, IconButton } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { DropdownMenu, type MenuEntry } from '@/ui/Menu';
import { loadNames } from '@/session/preferences';
import { go } from '@/session/route';
import { useSession } from '@/session/session';
import { ago, sections } from './projects';
import styles from './StartPage.module.css';

/** All projects: open, make, import. */
export default function StartPage() {
  const t = useText();
  const projects = useQuery(projectsQuery);
  const recent = useQuery({
    queryKey: ['settings', 'recent'],
    queryFn: () => loadNames('recent'),
    retry: false,
  });
  const { data: examples = [] } = useQuery(examplesQuery);
  const role = useSession((state) => state.user?.role ?? null);
  const refused = atLeast(role, 'engineer') ? null : t('reason.engineer');
  const [search, setSearch] = useState('');
  const [over, setOver] = useState(false);
  useEffect(() => {
    document.title = 'Tappet';
  }, []);

  const create = async (example?: Example) => {
    const { newProject } = await import('@/workbench/projectInfo/NewProjectDialog');
    const project = await newProject(example);
    if (project) go({ page: 'project', projectId: project.id });
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    if (refused) return;
    const dropped = droppedFiles(event.dataTransfer);
    void guard(async () => importFiles(await dropped));
  };
  const { recent: first, others } = sections(projects.data ?? [], recent.data ?? [], search);

  return (
    <div className={styles.page}>
      <header className={styles.bar}>
        <TappetMark size={20} />
        Tappet
        <UserMenu />
      </header>
      <main className={styles.main}>
        <nav className={styles.side} aria-label={t('start.begin')}>
          <h2 className={styles.heading}>{t('start.begin')}</h2>
          <StartAction icon={FilePlus} text={t('command.newProject')} refused={refused} run={() => void create()} />
          <StartAction
            icon={FileUp}
            text={t('start.import')}
            refused={refused}
            run={() => void guard(() => importFiles())}
          />
          {examples.length > 0 && <h2 className={styles.examples}>{t('start.examples')}</h2>}
          {examples.map((example) => {
            const { title, description } = exampleText(t, example);
            return (
              <StartAction
                key={example.name}
                icon={Cog}
                text={title}
                about={description}
                refused={refused}
                run={() => void create(example)}
              />
            );
          })}
        </nav>
        <section
          className={styles.content}
          aria-label={t('start.projects')}
          data-over={over ? '' : undefined}
          onDragOver={(event) => {
            if (!event.dataTransfer.types.includes('Files')) return;
            event.preventDefault();
            setOver(true);
          }}
          onDragLeave={() => setOver(false)}
          onDrop={drop}
        >
          <div className={styles.head}>
            <h1 className={styles.heading}>{t('start.projects')}</h1>
            {(projects.data?.length ?? 0) > 0 && (
              <TextInput
                className={styles.search}
                value={search}
                onValue={setSearch}
                placeholder={t('start.search')}
                aria-label={t('start.search')}
              />
            )}
          </div>
          {projects.isError ? (
            <Failed error={projects.error} retry={() => void projects.refetch()} />
          ) : !projects.data ? (
            <Loading />
          ) : projects.data.length === 0 ? (
            <Empty icon={Boxes} title={t('start.none')} text={t('start.noneText')}>
              <Button variant="primary" icon={FilePlus} disabledReason={refused} onClick={() => void create()}>
                {t('command.newProject')}
              </Button>
              <Button icon={FileUp} disabledReason={refused} onClick={() => void guard(() => importFiles())}>
                {t('start.import')}
              </Button>
            </Empty>
          ) : (
            <div className={styles.list}>
              <Section title={t('start.recent')} projects={first} refused={refused} />
              <Section title={first.length ? t('start.others') : null} projects={others} refused={refused} />
              {first.length + others.length === 0 && <Empty title={t('tree.nothingFound', { text: search.trim() })} />}
            </div>
          )}
        </section>
      </main>
    </div>
  );
}

interface StartActionProps {
  icon: typeof FilePlus;
  text: string;
  about?: string;
  refused: string | null;
  run: () => void;
}

function StartAction({ icon: Icon, text, about, refused, run }: StartActionProps) {
  return (
    <button
      type="button"
      className={styles.action}
      aria-disabled={refused ? true : undefined}
      title={refused ?? about}
      onClick={() => !refused && run()}
    >
      <Icon size={17} strokeWidth={1.6} aria-hidden />
      {text}
    </button>
  );
}

function Section({
  title,
  projects,
  refused,
}: {
  title: string | null;
  projects: readonly ProjectSummary[];
  refused: string | null;
}) {
  if (projects.length === 0) return null;
  return (
    <section>
      {title && <h2 className={styles.label}>{title}</h2>}
      {projects.map((project) => (
        <ProjectRow key={project.id} project={project} refused={refused} />
      ))}
    </section>
  );
}

function ProjectRow({ project, refused }: { project: ProjectSummary; refused: string | null }) {
  const t = useText();
  const language = useLanguage();
  const [now] = useState(() => Date.now());
  const open = () => go({ page: 'project', projectId: project.id });
  const entries = (): MenuEntry[] => [
    { kind: 'item', key: 'open', text: t('action.open'), icon: FolderOpen, run: open },
    {
      kind: 'item',
      key: 'export',
      text: t('start.export'),
      icon: Download,
      run: () => void guard(() => exportArchive(project)),
    },
    { kind: 'line', key: 'line' },
    {
      kind: 'item',
      key: 'delete',
      text: t('action.delete'),
      icon: Trash2,
      danger: true,
      disabledReason: refused,
      run: () => void deleteProject(project, t),
    },
  ];
  return (
    <div className={styles.project} onClick={open}>
      <ObjectIcon kind={kindWithRole('application')?.kind ?? ''} size={20} />
      <button type="button" className={styles.open}>
        <span className={styles.name}>{project.name}</span>
        {project.description && <span className={styles.description}>{project.description}</span>}
      </button>
      <time className={styles.date} dateTime={project.modified} title={secondText(project.modified)}>
        {ago(project.modified, now, language) ?? t('start.now')}
      </time>
      <span onClick={(event) => event.stopPropagation()}>
        <DropdownMenu
          align="end"
          entries={entries}
          trigger={<IconButton icon={Ellipsis} label={t('start.more', { name: project.name })} />}
        />
      </span>
    </div>
  );
}

async function deleteProject(project: ProjectSummary, t: ReturnType<typeof useText>): Promise<void> {
  const sure = await confirm({
    title: t('project.deleteTitle', { name: project.name }),
    text: t('project.deleteText'),
    action: t('action.delete'),
    danger: true,
  });
  if (!sure) return;
  await guard(async () => {
    await api.delete('/api/v1/projects/{project_id}', { params: { path: { project_id: project.id } } });
    await queryClient.invalidateQueries({ queryKey: keys.projects });
  });
}

async function exportArchive({ id, name }: ProjectSummary): Promise<void> {
  const params = { path: { project_id: id } };
  saveBlob(await api.download('/api/v1/projects/{project_id}/export', { params }), `${name}.zip`);
}

/** Makes a project of files: our own archive, or those of other systems. */
async function importFiles(files: readonly NamedFile[] = []): Promise<void> {
  const { ImportDialog } = await import('@/workbench/exchange/ImportDialog');
  await openDialog((close) => (
    <ImportDialog
      target={null}
      files={files}
      openProject={(projectId) => go({ page: 'project', projectId })}
      close={() => close()}
    />
  ));
}
