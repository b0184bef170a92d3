import { useEffect, useMemo } from 'react';
import { useStore } from 'zustand';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import type { EditorProps } from '@/workbench/editors';
import { setDirty } from '@/workbench/selection';
import { Failed, Loading } from '@/workbench/ui/Empty';
import { useHandlers } from '@/workbench/useHandlers';
import { DeclarationPane } from '../declaration/DeclarationPane';
import { DocumentBars } from '../documents/DocumentBars';
import { phaseOf } from '../documents/documentState';
import { useTextDocument, type OpenText } from '../documents/useTextDocument';
import { setEditorSettings, useEditorSettings } from '../settings';
import { textHandlers } from './handlers';
import { ImplementationPane } from './ImplementationPane';
import { partsShown } from './parts';
import { Splitter } from './Splitter';
import styles from './StEditor.module.css';
import { useReveal } from './useReveal';

/** Editor of every textual object: declaration above, implementation below (DECL-01). */
export default function StEditor(props: EditorProps) {
  const state = useTextDocument(props.projectId, props.objectId);
  if (state.status === 'loading') return <Loading />;
  if (state.status === 'failed') return <Failed error={state.error} retry={state.retry} />;
  return <OpenStEditor {...props} monaco={state.monaco} document={state.document} />;
}

function OpenStEditor(props: EditorProps & OpenText) {
  const { panelId, projectId, objectId, monaco, document, reveal } = props;
  const t = useText();
  const { data: objects } = useObjects(projectId);
  const object = objects?.find((candidate) => candidate.id === objectId);
  const share = useEditorSettings((settings) => settings.declarationShare);
  const changed = useStore(document.store, (state) => phaseOf(state) !== 'clean');
  useEffect(() => {
    setDirty(panelId, changed);
    return () => setDirty(panelId, false);
  }, [panelId, changed]);
  const handlers = useMemo(() => textHandlers(panelId, document), [panelId, document]);
  useHandlers(panelId, handlers);
  useReveal(panelId, reveal);

  if (object === undefined) return <Loading />;
  const parts = partsShown(object.kind);
  const declaration = parts.includes('declaration') && <DeclarationPane {...props} object={object} />;
  const implementation = parts.includes('implementation') && <ImplementationPane {...props} object={object} />;
  return (
    <div className={styles.editor} aria-label={t('st.editorOf', { name: object.name })}>
      <DocumentBars monaco={monaco} document={document} />
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
