/** Edits of several texts at once: undoable in each open text, and stored together. */
import { StaleObject } from '@/api/queries';
import { openDocument, type TextDocument } from '@/text/documents';
import type { Part } from '@/project/partUri';
import { saveTogether } from '@/text/saveTogether';
import type { Monaco } from '@/text/monacoLoader';
import { t } from '@/i18n';
import { applyTextEdits } from './convert';
import { parsePartUri } from '@/project/partUri';
import type { TextEdit, WorkspaceEdit } from './protocol';

export interface AppliedEdits {
  places: number;
  objects: number;
  /** Takes all of it back in one act, for the given reason; answers how many texts have been changed meanwhile and stay as they are. */
  undo: (comment: string) => Promise<number>;
}

interface Change {
  projectId: string;
  objectId: string;
  part: Part;
  before: string;
  after: string;
}

function editsByUri(edit: WorkspaceEdit): Map<string, TextEdit[]> {
  const all = new Map<string, TextEdit[]>(Object.entries(edit.changes ?? {}));
  for (const change of edit.documentChanges ?? []) {
    all.set(change.textDocument.uri, [...(all.get(change.textDocument.uri) ?? []), ...change.edits]);
  }
  return all;
}

/**
 * Carries edits out and stores the texts: each changes in one undoable step, all of them in one change of the project.
 * Throws when a text cannot be stored; then none is, and all have their former text.
 */
export async function applyEdits(monaco: Monaco, edit: WorkspaceEdit, comment: string): Promise<AppliedEdits> {
  const wanted = [...editsByUri(edit)].flatMap(([uri, edits]) => {
    const address = parsePartUri(uri);
    return address === null || edits.length === 0 ? [] : [{ ...address, edits }];
  });
  const changes = await withDocuments(monaco, wanted, async (documents) => {
    const made = wanted.map(({ edits, ...address }, at): Change => {
      const before = documents[at]!.models[address.part].getValue();
      return { ...address, before, after: applyTextEdits(before, edits) };
    });
    await change(made, documents, comment);
    return made;
  });
  return {
    places: wanted.reduce((sum, { edits }) => sum + edits.length, 0),
    objects: new Set(changes.map(({ objectId }) => objectId)).size,
    undo: (reason) => takeBack(monaco, changes, reason),
  };
}

async function takeBack(monaco: Monaco, changes: readonly Change[], comment: string): Promise<number> {
  return withDocuments(monaco, changes, async (documents) => {
    const same = changes.map(({ part, after }, at) => documents[at]!.models[part].getValue() === after);
    const back = changes.map((one) => ({ ...one, before: one.after, after: one.before }));
    await change(
      back.filter((_, at) => same[at]),
      documents.filter((_, at) => same[at]),
      comment,
    );
    return same.filter((unchanged) => !unchanged).length;
  });
}

/** Opens the document of each change, with all that was typed before stored. */
async function withDocuments<Result>(
  monaco: Monaco,
  changes: readonly { projectId: string; objectId: string }[],
  work: (documents: TextDocument[]) => Promise<Result>,
): Promise<Result> {
  const documents: TextDocument[] = [];
  try {
    for (const { projectId, objectId } of changes) documents.push(await openDocument(monaco, projectId, objectId));
    await Promise.all(documents.map((document) => document.save()));
    const unsaved = documents.find((document) => document.phase !== 'clean');
    if (unsaved !== undefined) throw new Error(t('st.editsUnsaved', { name: unsaved.name }));
    return await work(documents);
  } finally {
    documents.forEach((document) => document.release());
  }
}

async function change(changes: readonly Change[], documents: readonly TextDocument[], comment: string): Promise<void> {
  const [first] = changes;
  if (first === undefined) return;
  changes.forEach(({ part, after }, at) => documents[at]!.replaceText(part, after));
  try {
    await saveTogether(first.projectId, [...new Set(documents)], comment);
  } catch (error) {
    changes.forEach(({ part, before }, at) => documents[at]!.takeBack(part, before));
    throw error instanceof StaleObject ? new Error(t('st.editsStale', { name: error.current.name })) : error;
  }
}
