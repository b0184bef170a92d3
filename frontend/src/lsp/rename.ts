/** Rename of a symbol in all objects that use it. */
import type { editor } from 'monaco-editor/editor/editor.api';
import type { Monaco } from '@/text/monacoLoader';
import { t } from '@/i18n';
import type { LanguageClient } from './client';
import { toPosition } from './convert';
import { applyEdits, type AppliedEdits } from './edits';
import type { Range, WorkspaceEdit } from './protocol';

const at = (model: editor.ITextModel, position: { lineNumber: number; column: number }) => ({
  textDocument: { uri: model.uri.toString() },
  position: toPosition(position),
});

/** The name at the place and whether it can be renamed; throws with the server's reason when not. */
export async function renameTarget(
  client: LanguageClient,
  model: editor.ITextModel,
  position: { lineNumber: number; column: number },
): Promise<string | null> {
  const provider = client.capabilities.renameProvider;
  const word = model.getWordAtPosition(position)?.word ?? null;
  if (typeof provider !== 'object' || provider.prepareProvider !== true) return word;
  const answer = await client.demand<Range | { range: Range; placeholder: string } | null>(
    'textDocument/prepareRename',
    at(model, position),
  );
  if (answer === null) return null;
  return 'placeholder' in answer ? answer.placeholder : word;
}

/** Renames; throws with the server's reason when the new name is not possible. */
export async function renameSymbol(
  monaco: Monaco,
  client: LanguageClient,
  model: editor.ITextModel,
  position: { lineNumber: number; column: number },
  oldName: string,
  newName: string,
): Promise<AppliedEdits> {
  const edit = await client.demand<WorkspaceEdit | null>('textDocument/rename', { ...at(model, position), newName });
  return applyEdits(monaco, edit ?? {}, t('st.renameComment', { from: oldName, to: newName }));
}
