import { useCallback, useRef, useState } from 'react';
import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { ofKind } from '@/api/objects';
import { useObject } from '@/api/queries';
import { usePreferences } from '@/session/preferences';
import { useText } from '@/i18n';
import { objectIcon } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { useOnline } from '@/workbench/onlineSession';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { PastFrame } from './PastFrame';
import styles from './Scene.module.css';
import { pastCycleOf, runtimeOf } from './model';
import { ViewFrame } from './ViewFrame';
import type { ViserWindow } from './viserWindow';

/** A 3D scene of the machine, drawn by the server and moved by the values of the runtime, those of a past cycle too. */
export default function SceneEditor({ projectId, objectId, visible }: EditorProps) {
  const t = useText();
  const dark = usePreferences((state) => state.shown === 'dark');
  const runtimeId = useOnline((state) => runtimeOf(Object.values(state.sessions)));
  const cycle = useOnline((state) => pastCycleOf(Object.values(state.sessions)));
  const object = useObject(projectId, objectId, ofKind('scene'));
  const revision = object.data?.revision;
  const view = useQuery({
    queryKey: ['scene', projectId, objectId, revision, runtimeId, dark],
    queryFn: () =>
      api.post('/api/v1/projects/{project_id}/objects/{object_id}/view', {
        params: { path: { project_id: projectId, object_id: objectId } },
        body: { runtime_id: runtimeId, dark },
      }),
    enabled: visible && revision !== undefined,
    staleTime: Infinity,
    retry: false,
  });
  const live = useRef<ViserWindow | null>(null);
  const liveView = useCallback(() => live.current, []);
  const [lookedBack, setLookedBack] = useState(false);
  if (cycle !== null && !lookedBack) setLookedBack(true);
  const error = object.error ?? view.error;
  if (error) return <Failed error={error} retry={() => void view.refetch()} />;
  if (object.data?.data.elements.length === 0)
    return <Empty icon={objectIcon('scene')} title={t('scene.empty')} text={t('scene.emptyText')} />;
  if (!view.data) return <Loading />;
  const title = object.data?.name ?? t('scene.title');
  return (
    <div className={styles.views}>
      <ViewFrame
        src={view.data.path}
        title={title}
        shown={visible && cycle === null}
        testId="scene-view"
        onDrawn={(drawn) => (live.current = drawn)}
      />
      {lookedBack && (
        <PastFrame
          key={`${runtimeId} ${String(revision)} ${String(dark)}`}
          projectId={projectId}
          objectId={objectId}
          runtimeId={runtimeId}
          dark={dark}
          title={title}
          visible={visible}
          cycle={cycle}
          live={liveView}
        />
      )}
    </div>
  );
}
