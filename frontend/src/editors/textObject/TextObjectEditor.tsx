import { useEffect, useMemo } from 'react';
import { useStore } from 'zustand';
import { useObjects } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { useFollowedBookmarks } from '@/bookmarks/marks';
import { useText } from '@/i18n';
import { partsOf } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { setDirty } from '@/workbench/selection';
import { Failed, Loading } from '@/ui/Empty';
import { useHandlers } from '@/workbench/useHandlers';
import { DeclarationPane } from '../declaration/DeclarationPane';
import { DocumentBars } from '../documents/DocumentBars';
import { phaseOf } from '@/text/documentState';
import { useTextDocument, type OpenText } from '@/text/useTextDocument';
import { setEditorSettings, useEditorSettings } from '@/text/settings';
import { bodyOf } from '@/text/bodies';
import { registerBodies } from './bodies';
import { textHandlers } from './handlers';
import { registerQuickFixCommand } from '../text/applyQuickFix';
import { Splitter } from './Splitter';
import styles from './TextObjectEditor.module.css';
import { OnlineEditBar } from '../text/OnlineEditBar';
import { useReveal } from '../text/useReveal';

registerBodies();

/** Editor of every textual object: declaration above, implementation below (DECL-01). */
export default function StEditor(props: EditorProps) {
  const state = useTextDocument(props.projectId, props.objectId);
  if (state.status === 'loading') return <Loading />;
  if (state.status === 'failed') return <Failed error={state.error} retry={state.retry} />;
  return <OpenStEditor {...props} monaco={state.monaco} document={state.document} />;
}

function OpenStEditor(props: EditorProps & OpenText) {
  const { data: objects } = useObjects(props.projectId);
  const object = objects?.find((candidate) => candidate.id === props.objectId);
  return object === undefined ? <Loading /> : <StPanes {...props} object={object} />;
}

function StPanes(props: EditorProps & OpenText & { object: ObjectSummary }) {
  const { panelId, projectId, object, instance, monaco, document, reveal } = props;
  const t = useText();
  const share = useEditorSettings((settings) => settings.declarationShare);
  const changed = useStore(document.store, (state) => phaseOf(state) !== 'clean');
  useEffect(() => {
    setDirty(panelId, changed);
    return () => setDirty(panelId, false);
  }, [panelId, changed]);
  const handlers = useMemo(
    () => textHandlers(panelId, { monaco, document, projectId, object, instance }),
    [panelId, monaco, document, projectId, object, instance],
  );
  useHandlers(panelId, handlers);
  useEffect(() => registerQuickFixCommand(monaco), [monaco]);
  useReveal(panelId, reveal);
  useFollowedBookmarks(document);

  const parts = partsOf(object.kind);
  const declaration = parts.includes('declaration') && <DeclarationPane {...props} />;
  const { view: Implementation } = bodyOf(document.language);
  const implementation = parts.includes('implementation') && <Implementation {...props} />;
  return (
    <div className={styles.editor} aria-label={t('st.editorOf', { name: object.name })}>
      <DocumentBars monaco={monaco} document={document} />
      <OnlineEditBar object={object} />
      <div className={styles.panes}>
        {declaration && implementation ? (
          <Splitter
            top={declaration}
            bottom={implementation}
            share={share}
            onShare={(declarationShare) => setEditorSettings({ declarationShare })}
          />
        ) : (
          declaration || implementation
        )}
      </div>
    </div>
  );
}
