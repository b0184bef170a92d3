/** F1: the page of what stands where the keyboard focus is. */
import type { editor } from 'monaco-editor/editor/editor.api';
import { queryClient } from '@/api/queries';
import { parseLibraryUri, toPosition } from '@/lsp/convert';
import type { Location, LocationLink } from '@/lsp/protocol';
import { activeLanguageClient, openLocation } from '@/lsp/session';
import { OPERATORS } from '@/iec/grammar';
import { panelPlace, type TextPlace } from '@/text/focus';
import type { CommandContext } from '@/workbench/context';
import { useMessages } from '@/workbench/messages/store';
import { entryOfWord, tokenAt, viewOfPanel, type HelpEntry } from './model';
import { entriesQuery, openHelp } from './store';

const SIGNS: ReadonlySet<string> = new Set(OPERATORS);

/** Messages and tools explain themselves, texts what stands at the cursor. */
export async function helpHere(context: CommandContext): Promise<void> {
  const entries = await queryClient.fetchQuery(entriesQuery());
  const { focusedPanel, activeEditor } = context;
  const inEditor = activeEditor !== null && (focusedPanel === null || focusedPanel === activeEditor.panelId);
  if (inEditor) {
    const place = panelPlace(activeEditor.panelId);
    if (place !== null && (await helpAtCursor(entries, place, activeEditor.objectId))) return;
    openView(entries, activeEditor.kind, 'editor');
    return;
  }
  const code = focusedPanel === 'messages' ? useMessages.getState().current?.code : undefined;
  if (code !== undefined) openHelp({ kind: 'message', name: code });
  else openView(entries, viewOfPanel(focusedPanel ?? 'help'), 'help');
}

/** The page of the first of these views that has one. */
function openView(entries: readonly HelpEntry[], ...names: string[]): void {
  const name = names.find((one) => entries.some((entry) => entry.kind === 'view' && entry.name === one));
  if (name !== undefined) openHelp({ kind: 'view', name });
}

async function helpAtCursor(entries: readonly HelpEntry[], place: TextPlace, objectId: string): Promise<boolean> {
  const model = place.getModel();
  const position = place.getPosition();
  if (model === null || position === null) return false;
  const word = tokenAt(model.getLineContent(position.lineNumber), position.column, SIGNS);
  const known = entryOfWord(entries, word);
  if (known !== undefined) {
    openHelp(known);
    return true;
  }
  if (await openLibraryItem(model, position)) return true;
  const code = messageAt(objectId, position.lineNumber, position.column);
  if (code !== null) openHelp({ kind: 'message', name: code });
  return code !== null;
}

/** What a library declares has its documentation. */
async function openLibraryItem(
  model: editor.ITextModel,
  position: { lineNumber: number; column: number },
): Promise<boolean> {
  for (const question of ['textDocument/definition', 'textDocument/typeDefinition']) {
    const answer = await activeLanguageClient()
      ?.request<Location | (Location | LocationLink)[]>(question, {
        textDocument: { uri: model.uri.toString() },
        position: toPosition(position),
      })
      .catch(() => null);
    const first = Array.isArray(answer) ? answer[0] : answer;
    const uri = first == null ? null : 'targetUri' in first ? first.targetUri : first.uri;
    if (uri !== null && parseLibraryUri(uri) !== null) return openLocation(uri);
  }
  return false;
}

/** The code of the message that stands at a place of an object. */
function messageAt(objectId: string, line: number, column: number): string | null {
  const { live, build } = useMessages.getState();
  const messages = live.get(objectId) ?? build?.report.diagnostics.filter((one) => one.object_id === objectId) ?? [];
  const found = messages.find(
    (one) =>
      one.line !== null &&
      one.line <= line &&
      line <= (one.end_line ?? one.line) &&
      (one.line < line || (one.column ?? 1) <= column) &&
      ((one.end_line ?? one.line) > line || column <= (one.end_column ?? column)),
  );
  return found?.code ?? null;
}
