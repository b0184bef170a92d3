/** The parts of the Language Server Protocol 3.17 that the editors use. */

export interface Position {
  line: number;
  character: number;
}
export interface Range {
  start: Position;
  end: Position;
}
export interface Location {
  uri: string;
  range: Range;
}
export interface LocationLink {
  targetUri: string;
  targetSelectionRange: Range;
}
export interface TextEdit {
  range: Range;
  newText: string;
}
export type Markup = string | { kind?: string; language?: string; value: string };

export interface Diagnostic {
  range: Range;
  severity?: 1 | 2 | 3 | 4;
  code?: string | number;
  codeDescription?: { href: string };
  message: string;
  tags?: number[];
  relatedInformation?: { location: Location; message: string }[];
  data?: unknown;
}
export interface CompletionItem {
  label: string;
  labelDetails?: { detail?: string; description?: string };
  kind?: number;
  detail?: string;
  documentation?: Markup;
  deprecated?: boolean;
  preselect?: boolean;
  sortText?: string;
  filterText?: string;
  insertText?: string;
  insertTextFormat?: 1 | 2;
  textEdit?: TextEdit | { newText: string; insert: Range; replace: Range };
  additionalTextEdits?: TextEdit[];
  commitCharacters?: string[];
  data?: unknown;
}
export interface CompletionList {
  isIncomplete: boolean;
  items: CompletionItem[];
}
export interface Hover {
  contents: Markup | Markup[];
  range?: Range;
}
export interface DocumentSymbol {
  name: string;
  detail?: string;
  kind: number;
  range: Range;
  selectionRange: Range;
  children?: DocumentSymbol[];
}
export interface SignatureHelp {
  signatures: {
    label: string;
    documentation?: Markup;
    parameters?: { label: string | [number, number]; documentation?: Markup }[];
    activeParameter?: number;
  }[];
  activeSignature?: number;
  activeParameter?: number;
}
export interface WorkspaceEdit {
  changes?: Record<string, TextEdit[]>;
  documentChanges?: { textDocument: { uri: string; version?: number | null }; edits: TextEdit[] }[];
}
export interface ServerCapabilities {
  textDocumentSync?: number | { change?: number };
  completionProvider?: { triggerCharacters?: string[]; resolveProvider?: boolean };
  signatureHelpProvider?: { triggerCharacters?: string[]; retriggerCharacters?: string[] };
  semanticTokensProvider?: { legend: { tokenTypes: string[]; tokenModifiers: string[] }; full?: unknown };
  renameProvider?: boolean | { prepareProvider?: boolean };
}
export interface InitializeResult {
  capabilities: ServerCapabilities;
}

/** `window/showMessage`: 1 is an error, 2 a warning. */
export interface ShownMessage {
  type: number;
  message: string;
}
