import type { editor } from 'monaco-editor/editor/editor.api';
import { useCallback, useSyncExternalStore } from 'react';

/** The text of a model; the component draws again with every change of it. */
export function useModelText(model: editor.ITextModel): string {
  const subscribe = useCallback(
    (listener: () => void) => {
      const subscription = model.onDidChangeContent(listener);
      return () => subscription.dispose();
    },
    [model],
  );
  return useSyncExternalStore(subscribe, () => (model.isDisposed() ? '' : model.getValue()));
}
