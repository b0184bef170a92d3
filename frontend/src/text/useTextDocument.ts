import { useEffect, useReducer, useState } from 'react';
import { loadMonaco, type Monaco } from './monacoLoader';
import { loadEditorSettings } from './settings';
import { openDocument, type TextDocument } from './documents';

export interface OpenText {
  monaco: Monaco;
  document: TextDocument;
}

export type TextDocumentState =
  { status: 'loading' } | { status: 'failed'; error: unknown; retry: () => void } | ({ status: 'ready' } & OpenText);

/** Loads Monaco and the object's shared document, and holds it while the component is there. */
export function useTextDocument(projectId: string, objectId: string): TextDocumentState {
  const [attempt, retry] = useReducer((count: number) => count + 1, 0);
  const [state, setState] = useState<TextDocumentState>({ status: 'loading' });
  useEffect(() => {
    let gone = false;
    let held: TextDocument | null = null;
    void loadEditorSettings();
    loadMonaco()
      .then(async (monaco) => {
        const document = await openDocument(monaco, projectId, objectId);
        if (gone) document.release();
        else {
          held = document;
          setState({ status: 'ready', monaco, document });
        }
      })
      .catch((error: unknown) => {
        if (!gone) setState({ status: 'failed', error, retry });
      });
    return () => {
      gone = true;
      held?.release();
      setState({ status: 'loading' });
    };
  }, [projectId, objectId, attempt]);
  return state;
}
