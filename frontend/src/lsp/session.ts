/** The language client of the open project: started with the first text editor, changed with the project. */
import type { IDisposable, IPosition, IRange } from 'monaco-editor/editor/editor.api';
import { keys, queryClient } from '@/api/queries';
import type { Diagnostic, ObjectSummary } from '@/api/types';
import { openDocument, type TextDocument } from '@/text/documents';
import { useEditorSettings } from '@/text/settings';
import type { Monaco } from '@/text/monacoLoader';
import { openObject } from '@/workbench/docking/dock';
import { onLanguageChange } from '@/i18n';
import { showDocumentation } from '@/workbench/libraries/show';
import { publishDiagnostics } from '@/workbench/messages/store';
import { treePath } from '@/project/tree';
import { LanguageClient } from './client';
import { notify } from '@/ui/notices';
import { adviceOf, elementOf, parseLibraryUri, toneOf } from './convert';
import { parsePartUri, type PartAddress } from '@/project/partUri';
import type { Diagnostic as ServerDiagnostic } from './protocol';
import { registerProviders } from './providers';

let client: LanguageClient | null = null;
let providers: IDisposable[] = [];
let opener: IDisposable | null = null;
let languageChanges: (() => void) | null = null;

/** Texts opened only so that a peek view can show them; held until the project changes. */
const peeked = new Map<string, TextDocument>();
const MOST_PEEKED = 60;

/** How texts are formatted is the user's choice; the indentation goes with each request. */
function sendFormat(to: LanguageClient): void {
  const { formatKeywords, formatOperators, formatCommas } = useEditorSettings.getState();
  const format = { keywords: formatKeywords, operators: formatOperators, commas: formatCommas };
  to.notify('workspace/didChangeConfiguration', { settings: { tappet: { format } } });
}

useEditorSettings.subscribe((now, before) => {
  const same =
    now.formatKeywords === before.formatKeywords &&
    now.formatOperators === before.formatOperators &&
    now.formatCommas === before.formatCommas;
  if (client !== null && !same) sendFormat(client);
});

function nameOf(projectId: string, objectId: string): string {
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId));
  return objects?.find((object) => object.id === objectId)?.name ?? '';
}

/** The client for `projectId`, made when there is none yet. */
export function languageClient(monaco: Monaco, projectId: string): LanguageClient {
  if (client?.projectId === projectId) return client;
  closeLanguageClient();
  const made = new LanguageClient(monaco, projectId, publish, (message) =>
    notify({ tone: toneOf(message), title: message.message }),
  );
  client = made;
  const source = (uris: readonly string[]) => provideModels(monaco, uris);
  providers = registerProviders(monaco, made, source);
  made.onConnected(() => {
    sendFormat(made);
    providers.forEach((provider) => provider.dispose());
    providers = registerProviders(monaco, made, source);
  });
  languageChanges ??= onLanguageChange(() => client?.renew());
  opener ??= monaco.editor.registerEditorOpener({
    openCodeEditor: (_editor, resource, selection) =>
      openLocation(resource.toString(), selection === undefined ? undefined : rangeStart(selection)),
  });
  return made;
}

/** What was found in the two parts of each object; the message window shows them together. */
const found = new Map<string, Partial<Record<PartAddress['part'], Diagnostic[]>>>();
const SEVERITIES = { 1: 'error', 2: 'warning', 3: 'info', 4: 'info' } as const;

function publish(uri: string, diagnostics: readonly ServerDiagnostic[]): void {
  const address = parsePartUri(uri);
  if (address === null) return;
  const { projectId, objectId, part } = address;
  const objects = queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId)) ?? [];
  const messages = diagnostics.map((one): Diagnostic => ({
    code: String(one.code ?? ''),
    severity: SEVERITIES[one.severity ?? 1],
    message: one.message,
    advice: adviceOf(one),
    object_id: objectId,
    object_path: treePath(objects, objectId),
    part,
    element: elementOf(one),
    line: one.range.start.line + 1,
    column: one.range.start.character + 1,
    end_line: one.range.end.line + 1,
    end_column: one.range.end.character + 1,
  }));
  const own = { ...found.get(objectId), [part]: messages };
  found.set(objectId, own);
  publishDiagnostics(objectId, [...(own.declaration ?? []), ...(own.implementation ?? [])]);
}

/** Opens the text or the library page at an address; false where there is none. */
export function openLocation(uri: string, place = { line: 1, column: 1 }): boolean {
  const library = parseLibraryUri(uri);
  if (library !== null) {
    void showDocumentation(library.library, library.item);
    return true;
  }
  const address = parsePartUri(uri);
  if (address === null) return false;
  openObject(address.objectId, nameOf(address.projectId, address.objectId), {
    place: { part: address.part, ...place },
  });
  return true;
}

function rangeStart(selection: IRange | IPosition): { line: number; column: number } {
  return 'lineNumber' in selection
    ? { line: selection.lineNumber, column: selection.column }
    : { line: selection.startLineNumber, column: selection.startColumn };
}

/** The client of the open project, if a text editor has been shown yet. */
export function activeLanguageClient(): LanguageClient | null {
  return client;
}

async function provideModels(monaco: Monaco, uris: readonly string[]): Promise<void> {
  await Promise.all(
    uris.map(async (uri) => {
      const address = parsePartUri(uri);
      if (address === null || monaco.editor.getModel(monaco.Uri.parse(uri)) !== null) return;
      const document = await openDocument(monaco, address.projectId, address.objectId);
      if (peeked.has(address.objectId)) document.release();
      else peeked.set(address.objectId, document);
    }),
  );
  while (peeked.size > MOST_PEEKED) {
    const [oldest, document] = peeked.entries().next().value as [string, TextDocument];
    peeked.delete(oldest);
    document.release();
  }
}

function closeLanguageClient(): void {
  providers.forEach((provider) => provider.dispose());
  providers = [];
  client?.close();
  client = null;
  peeked.forEach((document) => document.release());
  peeked.clear();
  found.clear();
}
