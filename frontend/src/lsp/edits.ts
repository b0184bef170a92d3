/** Edits of several texts at once: those of open texts are undoable there, closed objects are saved at once. */
import { openDocument, type Part, type TextDocument } from '@/editors/documents/documents';
import type { Monaco } from '@/editors/st/monacoLoader';
import { applyTextEdits, parsePartUri } from './convert';
import type { TextEdit, WorkspaceEdit } from './protocol';

export interface AppliedEdits {
  places: number;
  objects: number;
  /** Takes all of it back in one act; answers how many texts have been changed meanwhile and stay as they are. */
  undo: () => Promise<number>;
}

interface Change {
  projectId: string;
  objectId: string;
  part: Part;
  before: string;
  after: string;
}

export function editsByUri(edit: WorkspaceEdit): Map<string, TextEdit[]> {
  const all = new Map<string, TextEdit[]>(Object.entries(edit.changes ?? {}));
  for (const change of edit.documentChanges ?? []) {
    all.set(change.textDocument.uri, [...(all.get(change.textDocument.uri) ?? []), ...change.edits]);
  }
  return all;
}

/** Carries edits out and stores the texts. Each text changes in one undoable step. */
export async function applyEdits(monaco: Monaco, edit: WorkspaceEdit): Promise<AppliedEdits> {
  const changes: Change[] = [];
  let places = 0;
  for (const [uri, edits] of editsByUri(edit)) {
    const address = parsePartUri(uri);
    if (address === null || edits.length === 0) continue;
    const document = await openDocument(monaco, address.projectId, address.objectId);
    const before = document.models[address.part].getValue();
    const after = applyTextEdits(before, edits);
    document.replaceText(address.part, after);
    await stored(document);
    changes.push({ ...address, before, after });
    places += edits.length;
  }
  return {
    places,
    objects: new Set(changes.map((change) => change.objectId)).size,
    undo: () => takeBack(monaco, changes),
  };
}

async function takeBack(monaco: Monaco, changes: readonly Change[]): Promise<number> {
  let left = 0;
  for (const { projectId, objectId, part, before, after } of changes) {
    const document = await openDocument(monaco, projectId, objectId);
    if (document.models[part].getValue() === after) document.replaceText(part, before);
    else left += 1;
    await stored(document);
  }
  return left;
}

async function stored(document: TextDocument): Promise<void> {
  await document.save();
  document.release();
}
