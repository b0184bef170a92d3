/** Applies a quick fix: edits of texts, a declaration, a library reference, new methods and properties. */
import { hasRole, kindOf, ofRole } from '@/project/kinds';
import { api } from '@/api/client';
import { shaped } from '@/api/objects';
import { keys, objectQuery, queryClient, saveObject } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { listed, t } from '@/i18n';
import { APPLY_QUICK_FIX, titleOfAction, type NewMember, type ServerAction } from '@/lsp/codeActions';
import { parsePartUri, type PartAddress } from '@/project/partUri';
import { applyEdits } from '@/lsp/edits';
import { guard, notify } from '@/ui/notices';
import { createObject } from '@/workbench/tree/acts';
import { applicationOf } from '@/project/tree';
import { openDocument } from '@/text/documents';
import { autoDeclare } from './acts';
import type { CodeEditor } from '@/text/CodePane';
import type { Monaco } from '@/text/monacoLoader';

interface QuickFixOrder {
  uri: string;
  action: ServerAction;
}

let registered = false;

/** Makes Monaco's light bulb able to act; once is enough for all editors. */
export function registerQuickFixCommand(monaco: Monaco): void {
  if (registered) return;
  registered = true;
  monaco.editor.registerCommand(
    APPLY_QUICK_FIX,
    (_accessor, order: QuickFixOrder) => void guard(() => applyQuickFix(monaco, order)),
  );
}

/** Carries out what an action is more than its title. */
export async function applyQuickFix(monaco: Monaco, { uri, action }: QuickFixOrder): Promise<void> {
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
  const application = applicationOf(objects, objectId)?.id;
  const managers = objects.filter((object) => hasRole(object, 'libraries'));
  const manager = managers.find((object) => object.parent_id === application) ?? managers[0];
  if (manager === undefined) {
    notify({ tone: 'warn', title: t('fix.noLibraryManager'), text: t('fix.noLibraryManagerText', { name }) });
    return;
  }
  const stored = await queryClient.fetchQuery({ ...objectQuery(projectId, manager.id), staleTime: 0 });
  const current = shaped(stored, ofRole('libraries'));
  const references = [...current.data.references, { name, version: '*', namespace: '' }];
  await saveObject(projectId, manager.id, current.revision, { ...current.data, references });
  notify({ tone: 'ok', title: t('fix.libraryAdded', { name }) });
}

/** Makes methods and properties below a block, with the heads that its interface demands. */
async function implement(projectId: string, owner: string, members: readonly NewMember[]): Promise<void> {
  const parent = parsePartUri(owner)?.objectId;
  if (parent === undefined) return;
  for (const { kind, name, declaration, accessors } of members) {
    const hasBody = kindOf(kind)?.parts?.includes('implementation');
    const data = hasBody ? { declaration, implementation: '' } : { declaration };
    const made = await createObject(projectId, { parent_id: parent, kind, name, data });
    const surplus = objectsOf(projectId).filter(
      (object) => object.parent_id === made.id && !accessors.includes(object.name),
    );
    for (const { id } of surplus) {
      const path = { project_id: projectId, object_id: id };
      await api.delete('/api/v1/projects/{project_id}/objects/{object_id}', { params: { path } });
    }
  }
  await queryClient.invalidateQueries({ queryKey: keys.objects(projectId) });
  notify({ tone: 'ok', title: t('fix.implemented', { names: listed(members.map((member) => member.name)) }) });
}
