import { useEffect, useRef, useState } from 'react';
import { api, ApiError } from '@/api/client';
import { Failed, Loading } from '@/ui/Empty';
import { PastView, type PastViewState } from './pastView';
import styles from './Scene.module.css';
import { ViewFrame } from './ViewFrame';
import { takeCamera, type ViserWindow } from './viserWindow';

interface PastFrameProps {
  projectId: string;
  objectId: string;
  runtimeId: string;
  dark: boolean;
  title: string;
  visible: boolean;
  /** The cycle to show; null: the present is shown, this view waits behind it. */
  cycle: number | null;
  /** The view of the present: one looks at the past from the same place, and the other way round. */
  live: () => ViserWindow | null;
}

/** A view of the scene at a past cycle, for this page alone. */
export function PastFrame({ projectId, objectId, runtimeId, dark, title, visible, cycle, live }: PastFrameProps) {
  const [state, setState] = useState<PastViewState>({ path: null, error: null });
  const [drawn, setDrawn] = useState<{ path: string; view: ViserWindow } | null>(null);
  const past = useRef<PastView | null>(null);
  useEffect(() => {
    const path = { project_id: projectId, object_id: objectId };
    const view = new PastView(
      {
        open: async (cycle) =>
          (
            await api.post('/api/v1/projects/{project_id}/objects/{object_id}/view', {
              params: { path },
              body: { runtime_id: runtimeId, dark, cycle },
            })
          ).path,
        move: (address, cycle) =>
          api.put('/api/v1/projects/{project_id}/objects/{object_id}/view/{view_id}/cycle', {
            params: { path: { ...path, view_id: viewOf(address) } },
            body: { cycle },
          }),
        gone: (error) => error instanceof ApiError && error.status === 404,
      },
      setState,
    );
    past.current = view;
    return () => view.close();
  }, [projectId, objectId, runtimeId, dark]);
  useEffect(() => {
    if (cycle !== null && visible) past.current?.show(cycle);
  }, [cycle, visible]);

  const shown = cycle !== null;
  const ready = drawn !== null && drawn.path === state.path;
  useEffect(() => {
    const other = live();
    if (!ready || other === null) return;
    if (shown) takeCamera(drawn.view, other);
    else takeCamera(other, drawn.view);
  }, [shown, ready, drawn, live]);
  return (
    <>
      {state.path !== null && (
        <ViewFrame
          key={state.path}
          src={state.path}
          title={title}
          shown={visible && shown && state.error === null}
          testId="scene-view-past"
          onDrawn={(view) => setDrawn({ path: state.path!, view })}
        />
      )}
      {shown && state.error === null && !ready && (
        <div className={styles.cover}>
          <Loading />
        </div>
      )}
      {shown && state.error !== null && (
        <div className={styles.cover}>
          <Failed error={state.error} retry={() => past.current?.show(cycle)} />
        </div>
      )}
    </>
  );
}

/** `/views/ID/` */
function viewOf(address: string): string {
  return address.split('/')[2] ?? '';
}
