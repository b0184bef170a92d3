import { useEffect, useRef } from 'react';
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
import { passKeysOn } from './frameKeys';
import { FrameLimit } from './frameLimit';
import styles from './Scene.module.css';
import { runtimeOf } from './model';

/** A 3D scene of the machine, drawn by the server and moved by the values of the runtime. */
export default function SceneEditor({ projectId, objectId, visible }: EditorProps) {
  const t = useText();
  const dark = usePreferences((state) => state.shown === 'dark');
  const runtimeId = useOnline((state) => runtimeOf(Object.values(state.sessions)));
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
  const limit = useRef<FrameLimit | null>(null);
  useEffect(() => {
    limit.current?.pause(!visible);
  }, [visible]);
  useEffect(() => {
    const yieldToInput = () => limit.current?.yieldToInput();
    const inputs = ['keydown', 'pointerdown', 'wheel'];
    inputs.forEach((input) => document.addEventListener(input, yieldToInput, { capture: true, passive: true }));
    return () => {
      inputs.forEach((input) => document.removeEventListener(input, yieldToInput, { capture: true }));
      limit.current?.dispose();
    };
  }, []);
  const loaded = (frame: HTMLIFrameElement) => {
    const view = frame.contentWindow;
    limit.current?.dispose();
    limit.current = view === null ? null : new FrameLimit(view);
    limit.current?.pause(!visible);
    if (view !== null) passKeysOn(view, frame);
  };
  const error = object.error ?? view.error;
  if (error) return <Failed error={error} retry={() => void view.refetch()} />;
  if (object.data?.data.elements.length === 0)
    return <Empty icon={objectIcon('scene')} title={t('scene.empty')} text={t('scene.emptyText')} />;
  if (!view.data) return <Loading />;
  return (
    <iframe
      className={styles.view}
      src={view.data.path}
      title={object.data?.name ?? t('scene.title')}
      onLoad={(event) => loaded(event.currentTarget)}
      data-testid="scene-view"
    />
  );
}
