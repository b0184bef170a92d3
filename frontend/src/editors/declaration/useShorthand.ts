import { useEffect } from 'react';
import { languageClient } from '@/lsp/session';
import type { CodeEditor } from '@/text/CodePane';
import type { Monaco } from '@/text/monacoLoader';

/** Ctrl+Enter behind a shorthand line replaces it by the complete declaration (DECL-13); the server knows the forms. */
export function useShorthand(monaco: Monaco, projectId: string, editor: CodeEditor | null): void {
  useEffect(() => {
    const action = editor?.addAction({
      id: 'declaration.expandShorthand',
      label: 'Expand shorthand declaration',
      keybindings: [monaco.KeyMod.CtrlCmd | monaco.KeyCode.Enter],
      run: async (target) => {
        const model = target.getModel();
        const line = target.getPosition()?.lineNumber;
        if (model === null || line === undefined) return;
        const text = model.getLineContent(line);
        const answer = await languageClient(monaco, projectId).request<{ line: string | null }>('tappet/shorthand', {
          line: text,
        });
        // Who has gone on typing meanwhile no longer means this line.
        if (target.getModel() !== model || model.getLineContent(line) !== text) return;
        const indentation = /^\s*/.exec(text)?.[0] ?? '';
        const range = { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: text.length + 1 };
        // A complete declaration is no shorthand: there Ctrl+Enter just opens the next line.
        const next = `${answer?.line ?? text.trimEnd()}\n${indentation}`;
        target.pushUndoStop();
        target.executeEdits('shorthand', [{ range, text: next }]);
        target.setPosition({ lineNumber: line + 1, column: indentation.length + 1 });
        target.pushUndoStop();
      },
    });
    return () => action?.dispose();
  }, [monaco, projectId, editor]);
}
