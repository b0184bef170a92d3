/** Carries out what mends a message: edits of texts, a declaration, a library reference, new methods and properties. */
import { api } from '@/api/client';
import { keys, queryClient, saveObject } from '@/api/queries';
import type { LibraryReference, ObjectSummary, ProjectObject } from '@/api/types';
import { t } from '@/i18n';
import { MEND, titleOfAction, type NewMember, type ServerAction } from '@/lsp/codeActions';
import { parsePartUri, type PartAddress } from '@/lsp/convert';
import { applyEdits } from '@/lsp/edits';
import { guard, notify } from '@/workbench/notices';
import { createObject } from '@/workbench/tree/acts';
import { ancestorOfKind } from '@/workbench/tree/model';
import { openDocument } from '../documents/documents';
import { autoDeclare } from './acts';
import type { CodeEditor } from './CodePane';
import type { Monaco } from './monacoLoader';

interface Mending {
  uri: string;
  action: ServerAction;
}

let registered = false;

/** Makes Monaco's light bulb able to act; once is enough for all editors. */
export function registerMending(monaco: Monaco): void {
  if (registered) return;
  registered = true;
  monaco.editor.registerCommand(MEND, (_accessor, mending: Mending) => void guard(() => mend(monaco, mending)));
}

/** Carries out what an action is more than its title. */
export async function mend(monaco: Monaco, { uri, action }: Mending): Promise<void> {
  const address = parsePartUri(uri);
  if (address === null) return;
  const { edit, data } = action;
  if (edit !== undefined && edit !== null) {
    await applyEdits(monaco, edit, titleOfAction(action));
    const elsewhere = Object.keys(edit.changes ?? {}).filter((other) => other !== uri);
    if (data?.key === 'declareAs' && elsewhere.length > 0)
      notify({ tone: 'ok', title: t('fix.declared', data.values) });
  }
  if (data?.declare) await declare(monaco, address, data.declare);
  if (data?.library) await addLibrary(address, data.library);
  if (data?.members) await implement(address.projectId, data.members.owner, data.members.items);
}

function objectsOf(projectId: string): readonly ObjectSummary[] {
  return queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
}

function editorOn(monaco: Monaco, uri: string): CodeEditor | undefined {
  const showing = monaco.editor.getEditors().filter((editor) => editor.getModel()?.uri.toString() === uri);
  return (showing.find((editor) => editor.hasWidgetFocus()) ?? showing[0]) as CodeEditor | undefined;
}

/** Opens the dialog of auto declare for a name. */
async function declare(monaco: Monaco, address: PartAddress, { name, type }: { name: string; type: string }) {
  const { projectId, objectId, part } = address;
  const object = objectsOf(projectId).find((candidate) => candidate.id === objectId);
  const editor = editorOn(monaco, `tappet:/${projectId}/${objectId}/${part}`);
  if (object === undefined) return;
  const document = await openDocument(monaco, projectId, objectId);
  try {
    await autoDeclare({ monaco, document, projectId, object, instance: null }, editor ?? null, name, type);
  } finally {
    document.release();
  }
}

/** Adds a reference to the library manager of the application around an object. */
async function addLibrary({ projectId, objectId }: PartAddress, name: string): Promise<void> {
  const objects = objectsOf(projectId);
  const application = ancestorOfKind(objects, objectId, 'application')?.id;
  const managers = objects.filter((object) => object.kind === 'library_manager');
  const manager = managers.find((object) => object.parent_id === application) ?? managers[0];
  if (manager === undefined) {
    notify({ tone: 'warn', title: t('fix.noLibraryManager'), text: t('fix.noLibraryManagerText', { name }) });
    return;
  }
  const current = await api.get<ProjectObject<{ references: LibraryReference[] }>>(
    `/projects/${projectId}/objects/${manager.id}`,
  );
  const references = [...current.data.references, { name, version: '*', namespace: '' }];
  await saveObject(projectId, manager.id, current.revision, { ...current.data, references });
  notify({ tone: 'ok', title: t('fix.libraryAdded', { name }) });
}

/** Makes methods and properties below a block, with the heads that its interface demands. */
async function implement(projectId: string, owner: string, members: readonly NewMember[]): Promise<void> {
  const parent = parsePartUri(owner)?.objectId;
  if (parent === undefined) return;
  for (const { kind, name, declaration, accessors } of members) {
    const data = kind === 'method' ? { declaration, implementation: '' } : { declaration };
    const made = await createObject(projectId, { parent_id: parent, kind, name, data });
    if (kind === 'method') continue;
    const surplus = objectsOf(projectId).filter(
      (object) => object.parent_id === made.id && object.kind === 'accessor' && !accessors.includes(object.name),
    );
    for (const accessor of surplus) await api.delete(`/projects/${projectId}/objects/${accessor.id}`);
  }
  await queryClient.invalidateQueries({ queryKey: keys.objects(projectId) });
  notify({ tone: 'ok', title: t('fix.implemented', { names: members.map((member) => member.name).join(', ') }) });
}
