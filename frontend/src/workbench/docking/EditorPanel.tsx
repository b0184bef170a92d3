import type { IDockviewPanelProps } from 'dockview-react';
import { FileQuestion, Trash2 } from 'lucide-react';
import { Suspense, useEffect, useRef, useState } from 'react';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { kindOf } from '@/project/kinds';
import { displayName } from '@/project/objectName';
import { useProject } from '@/project/openProject';
import { Button } from '@/ui/Button';
import { Empty, Loading } from '@/ui/Empty';
import { ErrorBoundary } from '@/ui/ErrorBoundary';
import { DataView } from './DataView';
import type { EditorParams } from './layout';
import { OnlineStripe } from './OnlineStripe';
import styles from './Panel.module.css';

/** A dock panel that holds the editor of one object. */
export function EditorPanel({ api, params }: IDockviewPanelProps<EditorParams>) {
  const t = useText();
  const visible = useVisible(api);
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const object = objects?.find((candidate) => candidate.id === params.objectId);
  const name = object && displayName(object);
  useEffect(() => {
    if (name !== undefined && api.title !== name) api.setTitle(name);
  }, [api, name]);

  const reveal = params.reveal;
  const frame = useRef<HTMLDivElement>(null);
  const known = object !== undefined;
  useEffect(() => {
    // Editors with a cursor take the focus from here once they are loaded.
    if (known && reveal?.focus && !frame.current?.contains(document.activeElement)) frame.current?.focus();
  }, [known, reveal]);

  if (!projectId || !objects) return <Loading />;
  if (!object) {
    return (
      <Empty icon={Trash2} title={t('editor.gone', { name: api.title ?? '' })} text={t('editor.goneText')}>
        <Button onClick={() => api.close()}>{t('editor.closeTab')}</Button>
      </Empty>
    );
  }
  const descriptor = kindOf(object.kind);
  const Editor = descriptor ? descriptor.editor : DataView;
  if (!Editor) {
    return (
      <Empty
        icon={FileQuestion}
        title={t('editor.none', { name: object.name })}
        text={t('editor.noneText', { kind: object.kind })}
      />
    );
  }
  return (
    <div ref={frame} className={styles.panel} data-panel-id={api.id} data-scope="editor" tabIndex={-1}>
      <OnlineStripe object={object} objects={objects} instance={params.instance} />
      <div className={styles.content}>
        <ErrorBoundary resetKey={object.id}>
          <Suspense fallback={<Loading />}>
            <Editor
              panelId={api.id}
              projectId={projectId}
              objectId={object.id}
              instance={params.instance}
              reveal={reveal}
              visible={visible}
            />
          </Suspense>
        </ErrorBoundary>
      </div>
    </div>
  );
}

/** Whether the panel is in front of its group. */
export function useVisible(api: IDockviewPanelProps['api']): boolean {
  const [visible, setVisible] = useState(api.isVisible);
  useEffect(() => {
    const listener = api.onDidVisibilityChange((event) => setVisible(event.isVisible));
    return () => listener.dispose();
  }, [api]);
  return visible;
}
