import { useCallback, useEffect, useMemo, useRef, useState, type ReactNode } from 'react';
import { ofKind } from '@/api/objects';
import { useObject } from '@/api/queries';
import { useText } from '@/i18n';
import type { EditorProps } from '@/project/editorProps';
import { useDraft } from '@/editors/form/useDraft';
import { endOnlineEdit, unlockEdit, useOnlineEdit } from '@/editors/text/onlineEdit';
import { useObjectSession } from '@/online/useObjectSession';
import { Failed, Loading } from '@/ui/Empty';
import { Tabs } from '@/ui/Tabs';
import { mayChangeText, mayEdit } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import { useCommandContext } from '@/workbench/useCommandContext';
import { CamGrid } from './CamGrid';
import { CamToolbar } from './CamToolbar';
import type { CamTable } from './camTable';
import styles from './Cam.module.css';
import { useCurves } from './curves';
import { WHOLE, type CamEdit, type Tool } from './edit';
import { ElementProperties } from './ElementProperties';
import { Findings } from './Findings';
import { GraphsTab } from './GraphsTab';
import { PreviewTab } from './PreviewTab';
import { RunningBar } from './RunningBar';
import { useFollowers } from './runningCam';
import { stillThere, type Selected } from './rows';
import { SettingsTab } from './SettingsTab';
import { TappetGrid } from './TappetGrid';
import { TappetsTab } from './TappetsTab';
import { useCamActs, type CamScene } from './useCamActs';

const always = () => true;

/** A cam: its four curves, its tappets, tables of both, and its properties (cam.md, sections 2 to 9). */
export default function CamEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const { data: object } = useObject(projectId, objectId, ofKind('cam'));
  const session = useObjectSession(projectId, object);
  const unlocked = useOnlineEdit((state) => state.unlocked.has(objectId));
  useEffect(() => {
    if (session === null && unlocked) endOnlineEdit(objectId);
  }, [session, unlocked, objectId]);
  // While logged in one agrees to change the project beside the application, as with texts.
  const mayChange = session !== null && unlocked ? mayChangeText : mayEdit;
  const scene = useRef<CamScene | null>(null);
  const context = useCommandContext();
  const allowed = mayChange(context);
  const acts = useCamActs(scene, session !== null, allowed);
  const draft = useDraft(panelId, projectId, objectId, ofKind('cam'), always, acts, mayChange);
  const runtimeId = session?.runtimeId ?? null;
  const followers = useFollowers(session, object?.name ?? '');
  const [shown, setShown] = useState<CamTable | null>(null);
  const [chosen, setChosen] = useState<Selected | null>(null);
  const [tool, setTool] = useState<Tool>('select');
  const [layout, setLayout] = useState(WHOLE);
  const cam = shown ?? draft.data;
  const curves = useCurves(projectId, cam);
  const { change: store, readOnly } = draft;
  const { valuesAt } = curves;
  const selected = cam === undefined ? null : stillThere(cam, chosen);
  const change = useCallback(
    (next: CamTable, select?: Selected | null) => {
      setShown(null);
      if (select !== undefined) setChosen(select);
      store(next);
    },
    [store],
  );
  const edit = useMemo(
    (): CamEdit | null =>
      cam === undefined
        ? null
        : {
            cam,
            drawing: curves.drawing,
            locked: readOnly !== null,
            selected,
            select: setChosen,
            change,
            preview: (next, select) => {
              setShown(next);
              if (select !== undefined) setChosen(select);
            },
            valuesAt: (x) => valuesAt(cam, x),
            running: runtimeId === null ? null : { runtimeId, followers },
          },
    [cam, curves.drawing, readOnly, selected, change, valuesAt, runtimeId, followers],
  );
  const name = draft.object?.name ?? '';
  useEffect(() => {
    scene.current = edit && { projectId, name, edit, session };
  });
  const may = mayChangeText(context);
  const forbidden = may === true ? null : reasonText(may);
  if (draft.error && !draft.object) return <Failed error={draft.error} />;
  if (edit === null || !draft.object) return <Loading />;

  const withTools = (content: ReactNode, tools: 'points' | 'tappets', drawn: boolean) => (
    <div className={styles.page}>
      <CamToolbar
        acts={acts}
        edit={edit}
        readOnly={readOnly}
        tool={tool}
        onTool={setTool}
        tools={tools}
        drawn={drawn}
        fit={tools === 'points' && layout.window !== null ? () => setLayout({ ...layout, window: null }) : null}
      />
      {session && draft.data && (
        <RunningBar
          session={session}
          name={name}
          cam={draft.data}
          followers={followers}
          editing={unlocked}
          onEdit={() => (unlocked ? endOnlineEdit : unlockEdit)(objectId)}
          forbidden={forbidden}
        />
      )}
      {draft.refused && (
        <div className={styles.refused} role="alert">
          {draft.refused}
        </div>
      )}
      {content}
      <Findings findings={curves.drawing?.findings ?? []} error={curves.error} again={curves.again} edit={edit} />
    </div>
  );
  const beside = (content: ReactNode, of: 'points' | 'tappets') => (
    <div className={styles.beside}>
      {content}
      <ElementProperties edit={edit} of={of} />
    </div>
  );
  const pages = [
    {
      id: 'graphs',
      title: t('cam.tab.graphs'),
      content: withTools(
        beside(<GraphsTab edit={edit} tool={tool} onTool={setTool} layout={layout} onLayout={setLayout} />, 'points'),
        'points',
        true,
      ),
    },
    { id: 'table', title: t('cam.tab.table'), content: withTools(<CamGrid edit={edit} />, 'points', false) },
    {
      id: 'tappets',
      title: t('cam.tab.tappets'),
      content: withTools(beside(<TappetsTab edit={edit} tool={tool} onTool={setTool} />, 'tappets'), 'tappets', true),
    },
    {
      id: 'tappetTable',
      title: t('cam.tab.tappetTable'),
      content: withTools(<TappetGrid edit={edit} />, 'tappets', false),
    },
    { id: 'preview', title: t('cam.tab.preview'), content: <PreviewTab projectId={projectId} edit={edit} /> },
    { id: 'settings', title: t('cam.tab.settings'), content: <SettingsTab draft={draft} edit={edit} /> },
  ];
  return <Tabs pages={pages} initial="graphs" />;
}
