import { useEffect } from 'react';
import { activeLanguageClient } from '@/lsp/session';
import { toPosition } from '@/lsp/convert';
import { useEditorSettings } from '@/text/settings';
import { autoDeclare, type TextPanel } from './acts';
import type { CodeEditor } from '@/text/CodePane';
import { undeclaredCandidates } from '@/iec/declareTarget';

/** After Enter: a name of the finished line that nobody has declared is asked for (DECL-60), unless the user types on. */
export function useAutoDeclare(panel: TextPanel, editor: CodeEditor | null): void {
  const enabled = useEditorSettings((settings) => settings.autoDeclare);
  useEffect(() => {
    if (editor === null || !enabled) return;
    const listener = editor.onDidChangeModelContent((event) => {
      const line = event.changes[0];
      if (event.isUndoing || event.isRedoing || event.changes.length !== 1 || !/^\r?\n[ \t]*$/.test(line?.text ?? ''))
        return;
      void ask(panel, editor, line?.range.startLineNumber ?? 1);
    });
    return () => listener.dispose();
  }, [panel, editor, enabled]);
}

async function ask(panel: TextPanel, editor: CodeEditor, line: number): Promise<void> {
  const model = editor.getModel();
  const client = activeLanguageClient();
  if (model === null || client === null || !/;\s*(\/\/.*)?$/.test(model.getLineContent(line))) return;
  const version = model.getVersionId();
  const start = model.getOffsetAt({ lineNumber: line, column: 1 });
  const end = start + model.getLineLength(line);
  for (const candidate of undeclaredCandidates(
    model.getValue(),
    start,
    end,
    panel.document.models.declaration.getValue(),
  )) {
    const position = toPosition(model.getPositionAt(candidate.start));
    const found = await client.request<unknown[] | object>('textDocument/definition', {
      textDocument: { uri: model.uri.toString() },
      position,
    });
    if (model.isDisposed() || model.getVersionId() !== version) return;
    const nowhere = found === null || (Array.isArray(found) && found.length === 0);
    const builtIn = found === null && (await isKnown(model.uri.toString(), position));
    if (nowhere && !builtIn) {
      await autoDeclare(panel, editor, candidate.name);
      return;
    }
  }
}

/** Operators and library items have no place in the project, but they have a hover text. */
async function isKnown(uri: string, position: object): Promise<boolean> {
  const hover = await activeLanguageClient()?.request('textDocument/hover', { textDocument: { uri }, position });
  return hover != null;
}
