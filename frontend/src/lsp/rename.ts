/** Rename of a symbol in all objects: edits of open texts are undoable, closed objects are saved at once. */
import type { editor } from 'monaco-editor/editor/editor.api';
import { openDocument } from '@/editors/documents/documents';
import type { Monaco } from '@/editors/st/monacoLoader';
import type { LanguageClient } from './client';
import { applyTextEdits, parsePartUri, toPosition } from './convert';
import type { Range, TextEdit, WorkspaceEdit } from './protocol';

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

function editsByUri(edit: WorkspaceEdit): Map<string, TextEdit[]> {
  const all = new Map<string, TextEdit[]>(Object.entries(edit.changes ?? {}));
  for (const change of edit.documentChanges ?? []) {
    all.set(change.textDocument.uri, [...(all.get(change.textDocument.uri) ?? []), ...change.edits]);
  }
  return all;
}

/** Renames and answers how many places in how many objects have changed. */
export async function renameSymbol(
  monaco: Monaco,
  client: LanguageClient,
  model: editor.ITextModel,
  position: { lineNumber: number; column: number },
  newName: string,
): Promise<{ places: number; objects: number }> {
  const edit = await client.demand<WorkspaceEdit | null>('textDocument/rename', { ...at(model, position), newName });
  let places = 0;
  const objects = new Set<string>();
  for (const [uri, edits] of editsByUri(edit ?? {})) {
    const address = parsePartUri(uri);
    if (address === null) continue;
    const document = await openDocument(monaco, address.projectId, address.objectId);
    const before = document.models[address.part].getValue();
    document.replaceText(address.part, applyTextEdits(before, edits));
    // The last view to let go stores the text.
    document.release();
    places += edits.length;
    objects.add(address.objectId);
  }
  return { places, objects: objects.size };
}
