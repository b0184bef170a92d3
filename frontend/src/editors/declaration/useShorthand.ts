import { useEffect } from 'react';
import type { CodeEditor } from '../st/CodePane';
import type { Monaco } from '../st/monacoLoader';
import { expandShorthand } from './shorthand';

/** Ctrl+Enter behind a shorthand line replaces it by the complete declaration (DECL-13). */
export function useShorthand(monaco: Monaco, editor: CodeEditor | null): void {
  useEffect(() => {
    const action = editor?.addAction({
      id: 'declaration.expandShorthand',
      label: 'Expand shorthand declaration',
      keybindings: [monaco.KeyMod.CtrlCmd | monaco.KeyCode.Enter],
      run: (target) => {
        const model = target.getModel();
        const line = target.getPosition()?.lineNumber;
        if (model === null || line === undefined) return;
        const text = model.getLineContent(line);
        // A complete declaration is no shorthand: there Ctrl+Enter just opens the next line.
        const expanded = text.includes(':') && !/^[^;]*;[^:]*:/.test(text) ? null : expandShorthand(text);
        const indentation = /^\s*/.exec(text)?.[0] ?? '';
        const range = { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: text.length + 1 };
        const next = `${indentation}${expanded ?? text.trim()}\n${indentation}`;
        target.pushUndoStop();
        target.executeEdits('shorthand', [{ range, text: next }]);
        target.setPosition({ lineNumber: line + 1, column: indentation.length + 1 });
        target.pushUndoStop();
      },
    });
    return () => action?.dispose();
  }, [monaco, editor]);
}
