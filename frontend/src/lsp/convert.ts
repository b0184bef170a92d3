/** Between the protocol's shapes (lines and characters from 0) and Monaco's (from 1). Pure functions. */
import type { IMarkdownString, IRange, editor, languages } from 'monaco-editor/editor/editor.api';
import type {
  CompletionItem,
  Diagnostic,
  DocumentSymbol,
  Hover,
  Markup,
  Position,
  Range,
  ShownMessage,
  SignatureHelp,
  TextEdit,
} from './protocol';

export function toPosition(position: { lineNumber: number; column: number }): Position {
  return { line: position.lineNumber - 1, character: position.column - 1 };
}

export function toRange(range: IRange): Range {
  return {
    start: { line: range.startLineNumber - 1, character: range.startColumn - 1 },
    end: { line: range.endLineNumber - 1, character: range.endColumn - 1 },
  };
}

export function fromRange(range: Range): IRange {
  return {
    startLineNumber: range.start.line + 1,
    startColumn: range.start.character + 1,
    endLineNumber: range.end.line + 1,
    endColumn: range.end.character + 1,
  };
}

export function fromMarkup(markup: Markup): IMarkdownString {
  if (typeof markup === 'string') return { value: markup };
  if (markup.language !== undefined) return { value: `\`\`\`${markup.language}\n${markup.value}\n\`\`\`` };
  if (markup.kind === 'plaintext') return { value: markup.value.replace(/[\\`*_{}[\]()#+\-!<>]/g, '\\$&') };
  return { value: markup.value };
}

export function fromHover(hover: Hover): languages.Hover {
  const contents = Array.isArray(hover.contents) ? hover.contents : [hover.contents];
  return { contents: contents.map(fromMarkup), range: hover.range && fromRange(hover.range) };
}

/** Monaco's numbers of completion kinds by the protocol's (1 Text .. 25 TypeParameter). */
const COMPLETION_KINDS: readonly number[] = [
  18, 18, 0, 1, 2, 3, 4, 5, 7, 8, 9, 12, 13, 15, 17, 28, 19, 20, 21, 23, 16, 14, 6, 10, 11, 24,
]; // prettier-ignore

export function fromCompletion(
  item: CompletionItem,
  word: IRange,
  snippetRule: languages.CompletionItemInsertTextRule,
): languages.CompletionItem {
  const edit = item.textEdit;
  const range =
    edit === undefined
      ? word
      : 'range' in edit
        ? fromRange(edit.range)
        : { insert: fromRange(edit.insert), replace: fromRange(edit.replace) };
  return {
    label: item.labelDetails === undefined ? item.label : { label: item.label, ...item.labelDetails },
    kind: COMPLETION_KINDS[item.kind ?? 1] ?? 18,
    detail: item.detail,
    documentation: item.documentation === undefined ? undefined : fromMarkup(item.documentation),
    sortText: item.sortText,
    filterText: item.filterText,
    preselect: item.preselect,
    insertText: edit?.newText ?? item.insertText ?? item.label,
    insertTextRules: item.insertTextFormat === 2 ? snippetRule : undefined,
    commitCharacters: item.commitCharacters,
    additionalTextEdits: item.additionalTextEdits?.map((e) => ({ range: fromRange(e.range), text: e.newText })),
    range,
  };
}

/** Monaco severities: Hint 1, Info 2, Warning 4, Error 8. */
const SEVERITIES = { 1: 8, 2: 4, 3: 2, 4: 1 } as const;

/** What would be right, when the server says it apart from the message. */
export function adviceOf(diagnostic: Diagnostic): string | null {
  const data = diagnostic.data as { advice?: unknown } | null | undefined;
  return typeof data?.advice === 'string' && data.advice !== '' ? data.advice : null;
}

/** The drawn element that a message is at. */
export function elementOf(diagnostic: Diagnostic): string | null {
  const data = diagnostic.data as { element?: unknown } | null | undefined;
  return typeof data?.element === 'string' ? data.element : null;
}

export function fromDiagnostic(diagnostic: Diagnostic): editor.IMarkerData {
  const advice = adviceOf(diagnostic);
  const range = fromRange(diagnostic.range);
  const empty = range.startLineNumber === range.endLineNumber && range.startColumn === range.endColumn;
  return {
    ...range,
    // An empty range would show no squiggle at all.
    endColumn: range.endColumn + (empty ? 1 : 0),
    severity: SEVERITIES[diagnostic.severity ?? 1],
    code: diagnostic.code === undefined ? undefined : String(diagnostic.code),
    message: advice === null ? diagnostic.message : `${diagnostic.message}\n${advice}`,
    source: undefined,
    tags: diagnostic.tags,
  };
}

export function fromSymbol(symbol: DocumentSymbol): languages.DocumentSymbol {
  return {
    name: symbol.name,
    detail: symbol.detail ?? '',
    kind: symbol.kind - 1,
    tags: [],
    range: fromRange(symbol.range),
    selectionRange: fromRange(symbol.selectionRange),
    children: symbol.children?.map(fromSymbol),
  };
}

export function fromSignatureHelp(help: SignatureHelp): languages.SignatureHelp {
  return {
    activeSignature: help.activeSignature ?? 0,
    activeParameter: help.activeParameter ?? 0,
    signatures: help.signatures.map((signature) => ({
      label: signature.label,
      documentation: signature.documentation === undefined ? undefined : fromMarkup(signature.documentation),
      activeParameter: signature.activeParameter,
      parameters: (signature.parameters ?? []).map((parameter) => ({
        label: parameter.label,
        documentation: parameter.documentation === undefined ? undefined : fromMarkup(parameter.documentation),
      })),
    })),
  };
}

export function fromTextEdit(edit: TextEdit): languages.TextEdit {
  return { range: fromRange(edit.range), text: edit.newText };
}

/** Applies edits to a text; used for objects that no view has open. Edits do not overlap. */
export function applyTextEdits(text: string, edits: readonly TextEdit[]): string {
  const starts = [0];
  for (let at = text.indexOf('\n'); at >= 0; at = text.indexOf('\n', at + 1)) starts.push(at + 1);
  const offset = (position: Position) => {
    const start = starts[position.line] ?? text.length;
    const end = starts[position.line + 1] ?? text.length + 1;
    return Math.min(start + position.character, Math.max(start, end - 1), text.length);
  };
  const ordered = edits.map((edit) => ({ edit, start: offset(edit.range.start), end: offset(edit.range.end) }));
  ordered.sort((a, b) => b.start - a.start || b.end - a.end);
  return ordered.reduce(
    (result, { edit, start, end }) => result.slice(0, start) + edit.newText + result.slice(end),
    text,
  );
}

export interface LibraryAddress {
  readonly library: string;
  /** Name of the item, not of a method in it. */
  readonly item: string;
}

const LIBRARY_URI = /^tappet-library:\/+([^/]+)\/([^/.#?]+)/;

/** Takes `tappet-library:/<library>/<item>` apart; null for any other address. */
export function parseLibraryUri(uri: string): LibraryAddress | null {
  const [, library, item] = LIBRARY_URI.exec(uri) ?? [];
  if (library === undefined || item === undefined) return null;
  return { library: decodeURIComponent(library), item: decodeURIComponent(item) };
}

/** How urgent a message of the server to people is. */
export function toneOf({ type }: ShownMessage): 'error' | 'warn' | 'info' {
  return type === 1 ? 'error' : type === 2 ? 'warn' : 'info';
}
