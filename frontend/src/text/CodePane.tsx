import type { editor } from 'monaco-editor/editor/editor.api';
import { useEffect, useRef } from 'react';
import { CODE_FONT } from './font';
import { indentation, useEditorSettings } from './settings';
import styles from './CodePane.module.css';
import type { Monaco } from './monacoLoader';

export type CodeEditor = editor.IStandaloneCodeEditor;

interface CodePaneProps {
  monaco: Monaco;
  model: editor.ITextModel;
  /** Name for screen readers. */
  label: string;
  readOnly: boolean;
  /** Called with the editor when it exists, and with null before it goes. */
  onEditor: (editor: CodeEditor | null) => void;
}

/** Where cursor and scroll bar were when a text was last shown, by its uri. */
const viewStates = new Map<string, editor.ICodeEditorViewState>();

let overflowNode: HTMLElement | null = null;

/** Suggestions and hovers may be larger than their pane: they hang on the page itself. */
function overflowWidgets(): HTMLElement {
  if (overflowNode === null) {
    overflowNode = document.createElement('div');
    overflowNode.className = `monaco-editor ${styles.overflow}`;
    document.body.append(overflowNode);
  }
  return overflowNode;
}

export const EDITOR_OPTIONS: editor.IStandaloneEditorConstructionOptions = {
  automaticLayout: true,
  fontFamily: `${CODE_FONT.family}, 'Noto Sans Mono CJK SC', ui-monospace, monospace`,
  fontLigatures: false,
  fontSize: CODE_FONT.size,
  lineHeight: 20,
  detectIndentation: false,
  autoIndent: 'full',
  glyphMargin: false,
  folding: true,
  lineNumbersMinChars: 4,
  lineDecorationsWidth: 10,
  minimap: { enabled: false },
  scrollBeyondLastLine: false,
  smoothScrolling: false,
  renderLineHighlight: 'line',
  renderWhitespace: 'selection',
  padding: { top: 4, bottom: 8 },
  scrollbar: { verticalScrollbarSize: 10, horizontalScrollbarSize: 10, useShadows: false },
  overviewRulerBorder: false,
  hideCursorInOverviewRuler: true,
  fixedOverflowWidgets: true,
  wordBasedSuggestions: 'off',
  quickSuggestions: { other: true, comments: false, strings: false },
  suggest: { showStatusBar: false, preview: false, showIcons: true },
  suggestSelection: 'first',
  // After a word typed in full (THEN, END_IF) Enter begins a new line.
  acceptSuggestionOnEnter: 'smart',
  parameterHints: { enabled: true, cycle: true },
  'semanticHighlighting.enabled': true,
  // The flat name is the one the standalone editor hands on to its models.
  ...({ 'bracketPairColorization.enabled': false } as object),
  matchBrackets: 'always',
  occurrencesHighlight: 'singleFile',
  stickyScroll: { enabled: false },
  links: false,
  colorDecorators: false,
  unicodeHighlight: { ambiguousCharacters: true, invisibleCharacters: true, nonBasicASCII: false },
  dropIntoEditor: { enabled: false },
  editContext: false,
  // The workbench has a menu of its own.
  contextmenu: false,
};

/** One Monaco editor on a model that others may show, too. */
export function CodePane({ monaco, model, label, readOnly, onEditor }: CodePaneProps) {
  const host = useRef<HTMLDivElement>(null);
  const instance = useRef<CodeEditor | null>(null);
  const latest = useRef(onEditor);
  useEffect(() => {
    latest.current = onEditor;
  });

  useEffect(() => {
    if (host.current === null) return;
    const uri = model.uri.toString();
    const made = monaco.editor.create(host.current, {
      ...EDITOR_OPTIONS,
      ...indentation(useEditorSettings.getState()),
      model,
      overflowWidgetsDomNode: overflowWidgets(),
    });
    const state = viewStates.get(uri);
    if (state !== undefined) made.restoreViewState(state);
    instance.current = made;
    latest.current(made);
    return () => {
      const last = made.saveViewState();
      if (last !== null) viewStates.set(uri, last);
      latest.current(null);
      instance.current = null;
      made.dispose();
    };
  }, [monaco, model]);

  const tabFocusMode = useEditorSettings((settings) => settings.tabMovesFocus);
  useEffect(() => {
    instance.current?.updateOptions({ readOnly, tabFocusMode, ariaLabel: label });
  }, [readOnly, tabFocusMode, label, monaco, model]);

  return <div ref={host} className={styles.pane} />;
}
