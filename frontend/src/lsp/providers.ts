/** Registers the language server's abilities with Monaco, for all IEC texts. */
import type { editor, IDisposable, languages } from 'monaco-editor/editor/editor.api';
import { textLanguages } from '@/text/languages';
import type { Monaco } from '@/text/monacoLoader';
import type { LanguageClient } from './client';
import { registerCodeActions } from './codeActions';
import {
  fromCompletion,
  fromHover,
  fromRange,
  fromSignatureHelp,
  fromSymbol,
  fromTextEdit,
  parseLibraryUri,
  toPosition,
} from './convert';
import { parsePartUri } from '@/project/partUri';
import type {
  CompletionItem,
  CompletionList,
  DocumentSymbol,
  Hover,
  Location,
  LocationLink,
  SignatureHelp,
  TextEdit,
} from './protocol';

/** Makes the texts of these addresses available as models, so that a peek view can show them. */
export type ModelSource = (uris: readonly string[]) => Promise<void>;

const at = (model: editor.ITextModel, position: { lineNumber: number; column: number }) => ({
  textDocument: { uri: model.uri.toString() },
  position: toPosition(position),
});

export function registerProviders(monaco: Monaco, client: LanguageClient, source: ModelSource): IDisposable[] {
  const { languages: registry } = monaco;
  const snippet = registry.CompletionItemInsertTextRule.InsertAsSnippet;
  const triggers = client.capabilities.completionProvider?.triggerCharacters ?? ['.', ':', '%'];
  const signature = client.capabilities.signatureHelpProvider;

  const locations = async (
    method: string,
    model: editor.ITextModel,
    params: object,
    token: Parameters<LanguageClient['request']>[2],
  ) => {
    const answer = await client.request<Location | (Location | LocationLink)[]>(method, params, token);
    const list = answer === null ? [] : Array.isArray(answer) ? answer : [answer];
    const found = list.map((place) =>
      'targetUri' in place ? { uri: place.targetUri, range: place.targetSelectionRange } : place,
    );
    const inProject = found.filter((place) => parsePartUri(place.uri) !== null);
    // A place in a library leads to its documentation; it has no text that could stand in a list of references.
    const inLibrary = found.filter((place) => parseLibraryUri(place.uri) !== null);
    const shown = inProject.length > 0 ? inProject : inLibrary.slice(0, 1);
    const own = model.uri.toString();
    await source([...new Set(inProject.map((place) => place.uri))].filter((uri) => uri !== own));
    return shown.map((place) => ({ uri: monaco.Uri.parse(place.uri), range: fromRange(place.range) }));
  };

  const texts = textLanguages();
  const made: IDisposable[] = [
    registry.registerCompletionItemProvider(texts, {
      triggerCharacters: triggers,
      provideCompletionItems: async (model, position, _context, token) => {
        const answer = await client.request<CompletionList | CompletionItem[]>(
          'textDocument/completion',
          at(model, position),
          token,
        );
        const word = model.getWordUntilPosition(position);
        const range = {
          startLineNumber: position.lineNumber,
          startColumn: word.startColumn,
          endLineNumber: position.lineNumber,
          endColumn: word.endColumn,
        };
        const items = answer === null ? [] : Array.isArray(answer) ? answer : answer.items;
        return {
          incomplete: answer !== null && !Array.isArray(answer) && answer.isIncomplete,
          suggestions: items.map((item) => fromCompletion(item, range, snippet)),
        };
      },
    }),
    registry.registerHoverProvider(texts, {
      provideHover: async (model, position, token) => {
        const hover = await client.request<Hover>('textDocument/hover', at(model, position), token);
        return hover === null ? null : fromHover(hover);
      },
    }),
    registry.registerDefinitionProvider(texts, {
      provideDefinition: (model, position, token) =>
        locations('textDocument/definition', model, at(model, position), token),
    }),
    registry.registerReferenceProvider(texts, {
      provideReferences: (model, position, context, token) =>
        locations('textDocument/references', model, { ...at(model, position), context }, token),
    }),
    registry.registerDocumentHighlightProvider(texts, {
      provideDocumentHighlights: async (model, position, token) => {
        const answer = await client.request<{ range: Location['range']; kind?: number }[]>(
          'textDocument/documentHighlight',
          at(model, position),
          token,
        );
        return answer?.map((h) => ({ range: fromRange(h.range), kind: (h.kind ?? 1) - 1 })) ?? null;
      },
    }),
    registry.registerDocumentSymbolProvider(texts, {
      provideDocumentSymbols: async (model, token) => {
        const params = { textDocument: { uri: model.uri.toString() } };
        const answer = await client.request<DocumentSymbol[]>('textDocument/documentSymbol', params, token);
        return answer?.map(fromSymbol) ?? [];
      },
    }),
    registry.registerSignatureHelpProvider(texts, {
      signatureHelpTriggerCharacters: signature?.triggerCharacters ?? ['(', ','],
      signatureHelpRetriggerCharacters: signature?.retriggerCharacters ?? [')'],
      provideSignatureHelp: async (model, position, token) => {
        const help = await client.request<SignatureHelp>('textDocument/signatureHelp', at(model, position), token);
        if (help === null || help.signatures.length === 0) return null;
        return { value: fromSignatureHelp(help), dispose: () => undefined };
      },
    }),
    registry.registerDocumentFormattingEditProvider(texts, {
      provideDocumentFormattingEdits: async (model, options, token) => {
        const params = { textDocument: { uri: model.uri.toString() }, options };
        const edits = await client.request<TextEdit[]>('textDocument/formatting', params, token);
        return edits?.map(fromTextEdit) ?? [];
      },
    }),
  ];
  made.push(
    registerCodeActions(monaco, client),
    registry.registerFoldingRangeProvider(texts, {
      provideFoldingRanges: async (model, _context, token) => {
        const params = { textDocument: { uri: model.uri.toString() } };
        const found = await client.request<{ startLine: number; endLine: number; kind?: string }[]>(
          'textDocument/foldingRange',
          params,
          token,
        );
        return found?.map((fold) => ({
          start: fold.startLine + 1,
          end: fold.endLine + 1,
          kind: fold.kind === undefined ? undefined : new registry.FoldingRangeKind(fold.kind),
        }));
      },
    }),
  );
  const legend = client.capabilities.semanticTokensProvider?.legend;
  if (legend !== undefined)
    made.push(registry.registerDocumentSemanticTokensProvider(texts, semanticTokens(client, legend)));
  return made;
}

function semanticTokens(
  client: LanguageClient,
  legend: languages.SemanticTokensLegend,
): languages.DocumentSemanticTokensProvider {
  return {
    getLegend: () => legend,
    provideDocumentSemanticTokens: async (model, _last, token) => {
      const params = { textDocument: { uri: model.uri.toString() } };
      const answer = await client.request<{ data: number[] }>('textDocument/semanticTokens/full', params, token);
      return answer === null ? null : { data: Uint32Array.from(answer.data) };
    },
    releaseDocumentSemanticTokens: () => undefined,
  };
}
