import { Plus } from 'lucide-react';
import { useCallback, useEffect, useMemo, useRef, useState } from 'react';
import { ofKind } from '@/api/objects';
import { useObject } from '@/api/queries';
import { useText } from '@/i18n';
import type { EditorProps } from '@/project/editorProps';
import { useDraft } from '@/editors/form/useDraft';
import { useObjectSession } from '@/online/useObjectSession';
import { Button } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { ContextMenu } from '@/ui/Menu';
import { explain } from '@/ui/notices';
import { atLeast, mayChangeText } from '@/workbench/rights';
import { useCommandContext } from '@/workbench/useCommandContext';
import { reasonText } from '@/workbench/run';
import { faultsOf, recordedPart, type Node, type TraceData } from './configuration';
import { useRecording, useRunning, useStoredRun, useTraceState } from './data/useRuns';
import type { DownloadProblem, Source } from './data/source';
import { Diagrams, seenTime } from './Diagrams';
import { traceOnline } from './online';
import { AnalysisPanel } from './panels/AnalysisPanel';
import { useOverlays } from './panels/useOverlays';
import { Problems, StateBar, StoredBar } from './StateBar';
import { menuEntriesOf, TraceIcon, TraceToolbar } from './TraceToolbar';
import { TraceSide } from './TraceSide';
import { FIRST_VIEW, type TraceView } from './traceView';
import { openConfiguration, useTraceActs, type Possible, type TraceScene } from './useTraceActs';
import styles from './Trace.module.css';

const canStore = (data: TraceData) => faultsOf(data).length === 0;

/** A trace: diagrams at the left, records and variables at the right, what is measured below (trace.md). */
export default function TraceEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const { data: object } = useObject(projectId, objectId, ofKind('trace'));
  const session = useObjectSession(projectId, object);
  const context = useCommandContext();
  const [view, setView] = useState<TraceView>(FIRST_VIEW);
  const [problems, setProblems] = useState<readonly DownloadProblem[]>([]);
  const scene = useRef<TraceScene | null>(null);
  const place = useRef<HTMLDivElement>(null);
  const name = object?.name ?? '';

  const { data: state } = useTraceState(session, name, object?.data.refresh_rate ?? 500);
  const running = useRunning(session, name, state);
  const { data: recording, error: noRecording } = useRecording(view.shown);
  const stored = useStoredRun(recording);
  // Of a stored recording only how it looks can be changed, and for the moment.
  const [shownData, setShownData] = useState<TraceData | null>(null);
  const [shownOf, setShownOf] = useState<string | null>(null);
  if (shownOf !== (recording?.id ?? null)) {
    setShownOf(recording?.id ?? null);
    setShownData(recording?.data ?? null);
  }
  const showsStored = view.shown !== null;
  const run = showsStored ? stored : running;
  const overlays = useOverlays(view.overlays);

  const possible: Possible = {
    editing: showsStored ? 'trace.reason.stored' : mayChangeText(context),
    display: showsStored || mayChangeText(context),
    variable: view.nodes.some(({ channel }) => channel !== null) || 'trace.reason.variable',
    configured: (object?.data.records.length ?? 0) > 0 || showsStored || 'trace.reason.configured',
    selected: view.nodes.length > 0 || 'trace.reason.selected',
    online: session === null ? 'reason.notLoggedIn' : session.lostSince === null || 'reason.connectionLost',
    operator: atLeast(context.role, 'operator') || 'reason.operator',
    downloaded: Boolean(state) || 'trace.reason.downloaded',
    recording: state?.running === true || 'trace.reason.stopped',
    stopped: state?.running === false || 'trace.reason.recording',
    shown: run !== null || 'trace.reason.shown',
    before: view.views.past.length > 0 || 'trace.reason.before',
    after: view.views.future.length > 0 || 'trace.reason.after',
    cursors: view.cursors.length === 2 || 'trace.reason.cursors',
  };
  const mayShow = possible.display === true;
  const acts = useTraceActs(scene, possible);
  const draft = useDraft(panelId, projectId, objectId, ofKind('trace'), canStore, acts, mayChangeText);
  const data = showsStored ? (shownData ?? undefined) : draft.data;
  const { change: store, readOnly } = draft;
  const change = useCallback(
    (next: TraceData) => (showsStored ? setShownData(next) : store(next)),
    [showsStored, store],
  );
  const live = !showsStored && run !== null;
  const shown = useMemo(
    (): Source | null =>
      view.shown !== null
        ? { kind: 'stored', id: view.shown }
        : state && session
          ? { kind: 'running', runtimeId: session.runtimeId, name }
          : null,
    [view.shown, state, session, name],
  );
  const online = traceOnline({
    projectId,
    name,
    runtimeId: session?.runtimeId ?? null,
    shown,
    data: draft.data ?? EMPTY,
    onProblems: setProblems,
    onShown: (id) => setView((before) => ({ ...before, shown: id, views: FIRST_VIEW.views, cursors: [] })),
  });
  const { tool, multi, cursors } = view;
  const tools = useMemo(() => ({ tool, multi, cursors }), [tool, multi, cursors]);
  const isRecording = Boolean(state?.recording);
  const menu = useCallback(() => menuEntriesOf(acts, tools, isRecording, t), [acts, tools, isRecording, t]);
  const open = useCallback((node: Node) => {
    if (scene.current) openConfiguration(scene.current, [node]);
  }, []);
  useEffect(() => {
    scene.current =
      data && object
        ? {
            projectId,
            object,
            data,
            readOnly: showsStored ? null : readOnly,
            mayShow,
            change,
            view,
            setView,
            seen: seenTime(data, run, live, view.views.now.x),
            session,
            state: state ?? null,
            online,
            place: () => place.current?.querySelector<HTMLElement>('[role="group"]') ?? null,
          }
        : null;
  }, [data, object, projectId, showsStored, readOnly, mayShow, change, view, run, live, session, state, online]);
  if (draft.error && !draft.object) return <Failed error={draft.error} />;
  if (noRecording) return <Failed error={noRecording} retry={() => setView(FIRST_VIEW)} />;
  if (!data || !draft.object) return <Loading />;

  const may = (id: keyof Possible) => possible[id];
  const first = [may('online'), may('operator'), may('configured')].find((one) => one !== true);
  const changed = running !== null && recordedPart(data) !== recordedPart(running.shape.data);
  const failure = run?.failure;
  return (
    <div className={styles.page}>
      <TraceToolbar acts={acts} view={tools} recording={isRecording} />
      {showsStored
        ? recording && (
            <StoredBar
              recording={recording}
              online={session !== null}
              onBack={() => setView((before) => ({ ...before, shown: null, views: FIRST_VIEW.views, cursors: [] }))}
            />
          )
        : data.records.length > 0 && (
            <StateBar
              session={session}
              state={state}
              changed={changed}
              download={() => void acts['trace.download']?.run()}
              forbidden={first === undefined ? null : reasonText(first)}
            />
          )}
      {draft.refused && (
        <div className={styles.bar} data-tone="error" role="alert">
          {draft.refused}
        </div>
      )}
      {failure != null && (
        <div className={styles.bar} data-tone="error" role="alert">
          {explain(failure).text ?? explain(failure).title}
        </div>
      )}
      <Problems problems={problems} data={data} onOpen={open} />
      <div className={styles.beside}>
        <div className={styles.main} ref={place}>
          {data.records.length === 0 ? (
            <Empty icon={TraceIcon} title={t('trace.empty')} text={t('trace.emptyText')}>
              <Button
                variant="primary"
                icon={Plus}
                disabledReason={readOnly}
                onClick={() => void acts['trace.addVariable']?.run()}
              >
                {t('trace.addVariable')}
              </Button>
              <Button onClick={() => void acts['trace.configuration']?.run()}>{t('trace.configuration')}</Button>
            </Empty>
          ) : (
            <ContextMenu entries={menu}>
              <div className={styles.diagrams}>
                <Diagrams data={data} run={run} overlays={overlays} live={live} view={view} onView={setView} />
              </div>
            </ContextMenu>
          )}
          <AnalysisPanel
            projectId={projectId}
            trace={name}
            data={data}
            run={run}
            live={live}
            overlays={overlays}
            view={view}
            onView={setView}
            onConfiguration={showsStored && readOnly === null ? (taken) => store(taken) : null}
          />
        </div>
        <TraceSide
          data={data}
          nodes={view.nodes}
          state={showsStored ? null : (state ?? null)}
          active={state?.running === true}
          acts={acts}
          menu={menu}
          scene={scene}
          open={open}
        />
      </div>
    </div>
  );
}

const EMPTY: TraceData = { refresh_rate: 500, points: 10_000, stacked: false, records: [] };
