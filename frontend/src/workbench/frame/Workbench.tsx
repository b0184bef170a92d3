import { hasRole } from '@/project/kinds';
import { useQuery } from '@tanstack/react-query';
import { useEffect, useRef, useState } from 'react';
import type { SerializedDockview } from 'dockview-react';
import { projectQuery, queryClient, testRunQuery, useObjects } from '@/api/queries';
import type { ObjectSummary, ProjectSummary } from '@/api/types';
import { loadNames, loadSetting, saveSetting } from '@/session/preferences';
import { go } from '@/session/route';
import { useText } from '@/i18n';
import { warnBeforeLeaving } from '../docking/close';
import { DockArea } from '../docking/DockArea';
import { restoreLayout } from '../docking/layout';
import { allBars } from '../bars';
import { openEvents, type ProjectEvents } from '../events';
import { forgetBuild } from '../messages/store';
import { forgetRelations } from '../online/knownRelation';
import { offlineTarget } from '../online/offlineTarget';
import { compareLogin, followRelation } from '../online/relation';
import { resumeLogins } from '../online/resume';
import { useOnline } from '../onlineSession';
import { Palette } from '../palette/Palette';
import { findPanel, loadPanels } from '../panels';
import { useProject } from '@/project/openProject';
import { startKeymap } from '../keymap/keymap';
import { listenToKeys } from '../run';
import { selectObjects, useSelection } from '../selection';
import { startTree } from '../tree/state';
import { usePlacement } from '../tree/TreePanel';
import { Button } from '@/ui/Button';
import { Failed, Loading } from '@/ui/Empty';
import { fetchWhileIdle } from '@/ui/onDemand';
import { MenuBar } from './MenuBar';
import { StatusBar } from './StatusBar';
import { Toolbar } from './Toolbar';
import styles from './Workbench.module.css';

/** The whole frame around one open project. */
export function Workbench({ projectId }: { projectId: string }) {
  const t = useText();
  const project = useQuery(projectQuery(projectId));
  const objects = useObjects(projectId);
  usePlacement();
  const failed = project.error ?? objects.error;
  const name = project.data?.name;
  useEffect(() => {
    document.title = name === undefined ? 'Tappet' : `${name} – Tappet`;
  }, [name]);
  useEffect(() => listenToKeys(), []);
  useEffect(() => startKeymap(), []);
  useEffect(() => {
    window.addEventListener('beforeunload', warnBeforeLeaving);
    return () => window.removeEventListener('beforeunload', warnBeforeLeaving);
  }, []);

  if (failed) {
    return (
      <div className={styles.frame}>
        <Failed error={failed} retry={() => void Promise.all([project.refetch(), objects.refetch()])} />
        <div style={{ padding: 24, textAlign: 'center' }}>
          <Button onClick={() => go({ page: 'start' })}>{t('start.backToProjects')}</Button>
        </div>
      </div>
    );
  }
  if (!project.data || !objects.data) return <Loading />;
  return <OpenWorkbench project={project.data} objects={objects.data} />;
}

/** The project has arrived: take over its layout, tree and active application, and listen to what others do. */
function OpenWorkbench({ project, objects }: { project: ProjectSummary; objects: readonly ObjectSummary[] }) {
  const projectId = project.id;
  const area = useRef<HTMLElement>(null);
  const [layout, setLayout] = useState<{ dock: SerializedDockview | null } | null>(null);
  const activeEditor = useSelection(
    (state) => state.editors.find((editor) => editor.panelId === state.activeEditor)?.objectId ?? null,
  );
  useEffect(() => useProject.setState({ projectName: project.name }), [project.name]);
  useActiveApplication(projectId, objects);
  useEffect(() => fetchWhileIdle(), []);

  useEffect(() => {
    let gone = false;
    const start = async () => {
      const [stored] = await Promise.all([
        loadSetting(`layout.${projectId}`).catch(() => null),
        startTree(projectId, objects),
        loadPanels(projectId),
      ]);
      const alive = new Set(objects.map((object) => object.id));
      if (gone) return;
      const size = { width: window.innerWidth, height: (area.current?.clientHeight ?? 0) || window.innerHeight };
      setLayout({
        dock: restoreLayout(stored, {
          panelExists: (id) => findPanel(id) !== undefined,
          objectExists: (id) => alive.has(id),
          size,
        }),
      });
    };
    void start();
    void rememberVisit(projectId);
    return () => {
      gone = true;
      selectObjects([]);
      forgetBuild();
      useOnline.setState({ sessions: {}, forces: {}, forcedPlaces: {} });
      forgetRelations();
      useProject.setState({ projectId: null, projectName: '', applicationId: null, busy: null });
    };
    // Once per project: later changes of the objects reach the views through their own queries.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [projectId]);

  const events = useRef<ProjectEvents | null>(null);
  useEffect(() => {
    const relation = followRelation(
      ({ applicationId, runtimeId }) => compareLogin(projectId, applicationId, runtimeId),
      offlineTarget,
    );
    const logins = resumeLogins(projectId);
    events.current = openEvents(projectId, relation.projectChanged);
    return () => {
      events.current?.close();
      relation.close();
      logins.close();
    };
  }, [projectId]);
  useEffect(() => events.current?.look(activeEditor), [activeEditor]);

  return (
    <div className={styles.frame}>
      <MenuBar />
      <Toolbar />
      {allBars().map((Bar, at) => (
        <Bar key={at} />
      ))}
      <main ref={area} className={styles.dock}>
        {layout && <DockArea projectId={projectId} layout={layout.dock} />}
      </main>
      <StatusBar />
      <Palette />
    </div>
  );
}

/** Keeps an existing application active: the one of the last visit, else the first. */
function useActiveApplication(projectId: string, objects: readonly ObjectSummary[]): void {
  const applicationId = useProject((state) => state.applicationId);
  useEffect(() => {
    useProject.setState({ projectId });
    void loadSetting(`application.${projectId}`)
      .catch(() => null)
      .then((stored) => {
        if (
          typeof stored === 'string' &&
          objects.some((object) => object.id === stored && hasRole(object, 'application'))
        )
          useProject.setState({ applicationId: stored });
      });
    // eslint-disable-next-line react-hooks/exhaustive-deps -- the stored choice is read once per project
  }, [projectId]);
  useEffect(() => {
    const applications = objects.filter((object) => hasRole(object, 'application'));
    if (!applications.some((application) => application.id === applicationId)) {
      useProject.setState({ applicationId: applications[0]?.id ?? null });
    } else if (applicationId) void saveSetting(`application.${projectId}`, applicationId).catch(() => undefined);
    // The menu says at once whether there are tests to run again.
    if (applicationId) void queryClient.prefetchQuery(testRunQuery(projectId, applicationId));
  }, [projectId, objects, applicationId]);
}

const RECENT = 12;

/** Puts the project at the head of the recent ones. */
async function rememberVisit(projectId: string): Promise<void> {
  const recent = (await loadNames('recent').catch(() => null)) ?? [];
  await saveSetting('recent', [projectId, ...recent.filter((id) => id !== projectId)].slice(0, RECENT)).catch(
    () => undefined,
  );
}
