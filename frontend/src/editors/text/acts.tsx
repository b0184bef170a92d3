/** Larger acts of a text editor: input assistant, auto declare, rename, revisions, add to watch. */
import { kindOf, valuesOf } from '@/project/kinds';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { toPosition } from '@/lsp/convert';
import type { AppliedEdits } from '@/lsp/edits';
import { activeLanguageClient } from '@/lsp/session';
import { renameSymbol, renameTarget } from '@/lsp/rename';
import { crossReferences } from '@/lsp/symbols';
import { breakOnChange } from '@/online/dataBreakpoint';
import { objectSession } from '@/online/useObjectSession';
import { useWatchLists } from '@/online/watch/lists';
import { addExpressions } from '@/online/watch/ownLists';
import { openDialog } from '@/ui/dialogs';
import { guard, notify } from '@/ui/notices';
import { runCommand } from '@/workbench/run';
import { applicationOf } from '@/project/tree';
import { showCrossReferencesAt } from '../crossReferences/place';
import { InputAssistant } from '../assistant/InputAssistant';
import { parseDeclaration } from '@/iec/declaration/parse';
import { insertRow } from '@/iec/declaration/structure';
import { openDocument } from '@/text/documents';
import type { OpenText } from '@/text/useTextDocument';
import { monitorTarget, owningPou } from '@/project/monitorScope';
import { setEditorSettings, useEditorSettings } from '@/text/settings';
import { AutoDeclareDialog, type Declared } from './AutoDeclareDialog';
import type { CodeEditor } from '@/text/CodePane';
import { typeByName } from '@/iec/declareTarget';
import type { TextPlace } from '@/text/focus';
import { isKeyword } from '@/iec/keywords';
import { partLabels } from '@/text/labels';
import { RenameDialog } from './RenameDialog';
import { expressionOf, findVariables } from '@/iec/variables';
import { valueTokens } from '@/text/bodies';

export interface TextPanel extends OpenText {
  projectId: string;
  object: ObjectSummary;
  instance: string | null;
}

function objectsOf(projectId: string): readonly ObjectSummary[] {
  return queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
}

/** F2: what is chosen replaces the word at the cursor. */
export async function inputAssistant({ projectId, object }: TextPanel, editor: CodeEditor): Promise<void> {
  const model = editor.getModel();
  const position = editor.getPosition();
  if (model === null || position === null) return;
  const before = model.getWordUntilPosition(position);
  // Behind a keyword something new begins.
  const word = isKeyword(before.word) ? { word: '', startColumn: position.column } : before;
  const chosen = await openDialog<string>((close) => (
    <InputAssistant projectId={projectId} object={object} typed={word.word} close={close} />
  ));
  editor.focus();
  if (chosen === undefined) return;
  const range = {
    startLineNumber: position.lineNumber,
    endLineNumber: position.lineNumber,
    startColumn: word.startColumn,
    endColumn: position.column,
  };
  editor.pushUndoStop();
  editor.executeEdits('inputAssistant', [{ range, text: chosen, forceMoveMarkers: true }]);
  editor.pushUndoStop();
}

/** Shift+F2: declares the name at the cursor in this object or in a variable list. */
export async function autoDeclare(
  panel: TextPanel,
  editor: TextPlace | null,
  name?: string,
  proposedType?: string,
): Promise<void> {
  const { monaco, projectId, object, document } = panel;
  const position = editor?.getPosition() ?? null;
  const found = name ?? (position === null ? '' : (editor?.getModel()?.getWordAtPosition(position)?.word ?? ''));
  const word = isKeyword(found) ? '' : found;
  const objects = objectsOf(projectId);
  // An action declares in its POU.
  const own = valuesOf(object) === 'owner' ? (owningPou(objects, object) ?? object) : object;
  const application = applicationOf(objects, object.id)?.id;
  const lists = objects.filter(
    (o) => kindOf(o.kind)?.declares !== undefined && applicationOf(objects, o.id)?.id === application,
  );
  const declaration = own.id === object.id ? document.models.declaration.getValue() : '';
  const keyword = parseDeclaration(declaration).header?.keyword.text.toUpperCase() ?? (own.subkind ?? '').toUpperCase();
  const declared = await openDialog<Declared>((close) => (
    <AutoDeclareDialog
      projectId={projectId}
      object={object}
      places={[own, ...lists]}
      keyword={keyword}
      start={{
        scope: 'VAR',
        flags: [],
        name: word,
        type: proposedType ?? typeByName(word, useEditorSettings.getState().lastType),
      }}
      close={close}
    />
  ));
  editor?.focus();
  if (declared === undefined) return;
  setEditorSettings({ lastType: declared.variable.type });
  const target = await openDocument(monaco, projectId, declared.objectId);
  target.replaceText('declaration', insertRow(target.models.declaration.getValue(), null, declared.variable));
  target.release();
}

/** Ctrl+F2: gives a symbol another name wherever it is used, after a look at all the places. */
export async function rename({ monaco, projectId }: TextPanel, editor: TextPlace): Promise<void> {
  const client = activeLanguageClient();
  const model = editor.getModel();
  const position = editor.getPosition();
  if (client === null || model === null || position === null) return;
  const name = await renameTarget(client, model, position);
  if (name === null) {
    notify({ tone: 'info', title: t('st.nothingToRename') });
    return;
  }
  const textDocument = { uri: model.uri.toString() };
  const places = await crossReferences(projectId, { textDocument, position: toPosition(position) });
  let done: AppliedEdits | null = null;
  let chosen = name;
  await openDialog<void>((close) => (
    <RenameDialog
      name={name}
      places={places}
      nameOf={(uri) => partLabels.getUriBasenameLabel({ path: uri.slice(uri.indexOf('/')), toString: () => uri })}
      rename={async (next) => {
        done = await renameSymbol(monaco, client, model, position, name, next);
        chosen = next;
      }}
      close={close}
    />
  ));
  editor.focus();
  if (done !== null) tellRenamed(name, chosen, done);
}

function tellRenamed(before: string, name: string, { places, objects, undo }: AppliedEdits): void {
  const takeBack = async () => {
    const left = await undo(t('st.renameComment', { from: name, to: before }));
    if (left > 0) notify({ tone: 'warn', title: t('st.renameKept', { count: left }) });
  };
  notify({
    tone: 'ok',
    title: t('st.renamed', {
      name,
      places: t('st.places', { count: places }),
      objects: t('st.objects', { count: objects }),
    }),
    action: { text: t('st.renameUndo'), run: () => void guard(takeBack) },
  });
}

/** Alt+Shift+F12: every place of what stands at the cursor, in the panel. */
export async function showCrossReferences({ projectId }: TextPanel, place: TextPlace): Promise<void> {
  await showCrossReferencesAt(projectId, place);
}

/** The history of the object, its text with it. */
export async function revisions({ object }: TextPanel): Promise<void> {
  await runCommand('object.history', object);
}

/** Paths of declared variables as the runtime knows them; none of those that have no value of their own. */
export function variablesOf(
  { projectId, object, instance }: Pick<TextPanel, 'projectId' | 'object' | 'instance'>,
  declaration: string,
  rows: readonly { readonly name: { readonly text: string } }[],
): string[] {
  const { path, temporary } = monitorTarget(objectsOf(projectId), object, instance, declaration);
  if (path === null) return [];
  return rows
    .map((row) => row.name.text)
    .flatMap((name) => (temporary.has(name.toUpperCase()) ? [] : `${path}.${name}`));
}

/** Halts when the variable at the cursor changes. */
export async function breakOnChangeAt(panel: TextPanel, chosen: readonly string[]): Promise<void> {
  const runtimeId = objectSession(panel.projectId, panel.object.id)?.runtimeId;
  const expression = chosen[0];
  if (expression === undefined) notify({ tone: 'info', title: t('debugger.reason.noVariableHere') });
  else if (runtimeId !== undefined) await breakOnChange(runtimeId, expression);
}

/** Paths of the variable at the cursor, or of those in the selection, as the runtime knows them. */
export function watchable({ projectId, object, instance, document }: TextPanel, editor: TextPlace): string[] {
  const model = editor.getModel();
  const selection = editor.getSelection();
  if (model === null || selection === null) return [];
  const declaration = document.models.declaration.getValue();
  const { path, temporary } = monitorTarget(objectsOf(projectId), object, instance, declaration);
  const names = new Set(parseDeclaration(declaration).rows.map((row) => row.name.text.toUpperCase()));
  const scope = { instance: path, members: names, temporary };
  const from = model.getOffsetAt(selection.getStartPosition());
  const to = model.getOffsetAt(selection.getEndPosition());
  const inDeclaration = model === document.models.declaration;
  const found = inDeclaration
    ? variablesOf(
        { projectId, object, instance },
        declaration,
        parseDeclaration(declaration).rows.filter((row) => row.name.end >= from && row.element.start <= to),
      )
    : findVariables(model.getValue(), valueTokens(model.getValue()))
        .filter((use) => use.end >= from && use.start <= to)
        .map((use) => expressionOf(use.path, scope, () => null));
  return [...new Set(found.flatMap((expression) => expression ?? []))];
}

/** To a watch list, which comes to the front: the one used last unless another is named; null asks for a new one. */
export async function addToWatch(found: readonly string[], argument?: unknown): Promise<void> {
  const expressions = found.filter((expression) => expression !== '');
  if (expressions.length === 0) {
    notify({ tone: 'info', title: t('watch.nothingHere') });
    return;
  }
  const { list = useWatchLists.getState().current } = (argument ?? {}) as { list?: string | null };
  await addExpressions(expressions, list);
}
