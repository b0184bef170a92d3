/** DIN 66025 in Monaco: colours, hovers, completions, folds and quick fixes, all from the program behind the model. */
import type { editor, languages } from 'monaco-editor/editor/editor.api';
import { onLanguageChange, t } from '@/i18n';
import type { Monaco } from '@/text/monacoLoader';
import { openPrograms, programOf } from './cncDocument';
import { proposalsAt, type Proposal } from './completion';
import { fixesOf } from './fixes';
import { foldsOf } from './folding';
import { CNC_TEXT } from './languageName';
import { explained, inForce, positionText } from './meaning';
import { renumbered } from './operations/renumber';
import { usedVariables } from './variables';

export const tokens: languages.IMonarchLanguage = {
  ignoreCase: true,
  tokenizer: {
    root: [
      [/^\s*%.*$/, 'annotation'],
      [/^\s*\//, 'annotation'],
      [/\/\/.*$/, 'comment'],
      [/\([^)]*\)?/, 'comment'],
      [/\$[^$]*\$/, 'string'],
      [/\b(?:LET|SUBPROGRAM|END_SUBPROGRAM|RETURN)\b/, 'keyword'],
      [/#\w+/, 'string'],
      [/N(?=\d)/, { token: 'delimiter', next: '@number' }],
      [/[GM][+-]?[\d.]+/, 'keyword'],
      [/(?:PROBE|FF|EF|[FE][ZABCPQUVW]|[FEDS])(?=[+\-.\d$#{])/, 'variable.address'],
      [/[HLOT](?=[+\-.\d$#{])/, 'type'],
      [/[A-Z](?=[+\-.\d$#{])/, 'function'],
      [/[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?/, 'number'],
    ],
    number: [[/\d+/, { token: 'delimiter', next: '@pop' }]],
  },
};

const configuration: languages.LanguageConfiguration = {
  comments: { lineComment: '//', blockComment: ['(', ')'] },
  brackets: [['(', ')']],
  autoClosingPairs: [
    { open: '(', close: ')' },
    { open: '$', close: '$' },
  ],
  wordPattern: /\$[\w.]*\$?|[A-Za-z]+[+-]?[\d.]*/,
};

let registered = false;

/** Makes the language known to Monaco, once. */
export function registerCncLanguage(monaco: Monaco): void {
  if (registered) return;
  registered = true;
  const { languages: known } = monaco;
  known.register({ id: CNC_TEXT, extensions: ['.cnc'] });
  known.setLanguageConfiguration(CNC_TEXT, configuration);
  known.setMonarchTokensProvider(CNC_TEXT, tokens);
  known.registerHoverProvider(CNC_TEXT, { provideHover: (model, at) => hoverAt(model, at.lineNumber, at.column) });
  known.registerFoldingRangeProvider(CNC_TEXT, {
    provideFoldingRanges: (model) =>
      foldsOf(model.getValue()).map(({ start, end }) => ({ start: start + 1, end: end + 1 })),
  });
  known.registerCompletionItemProvider(CNC_TEXT, {
    triggerCharacters: ['$', ' ', 'G', 'g'],
    provideCompletionItems: (model, at) => ({ suggestions: suggestionsAt(monaco, model, at.lineNumber, at.column) }),
  });
  known.registerCodeActionProvider(CNC_TEXT, {
    provideCodeActions: (model, range, context) => ({
      actions: actionsAt(model, range.startLineNumber, range.endLineNumber, context.markers),
      dispose: () => undefined,
    }),
  });
  onLanguageChange(() => openPrograms().forEach((program) => program.show()));
}

function hoverAt(model: editor.ITextModel, lineNumber: number, column: number): languages.Hover | null {
  const program = programOf(model)?.program;
  if (program === undefined) return null;
  const line = lineNumber - 1;
  const state = program.stateBefore(line);
  const found = explained(program.block(line), column - 1, state);
  if (found === null) return null;
  const { word, title, about } = found;
  return {
    range: {
      startLineNumber: lineNumber,
      endLineNumber: lineNumber,
      startColumn: word.at + 1,
      endColumn: word.end + 1,
    },
    contents: [
      { value: `**${title.replace(/[\\`*_{}[\]<>$]/g, '\\$&')}** ${about}` },
      { value: `${t('cnc.before')}: \`${inForce(state)}\`\n\n${t('cnc.position')}: \`${positionText(state)}\`` },
    ],
  };
}

function suggestionsAt(
  monaco: Monaco,
  model: editor.ITextModel,
  lineNumber: number,
  column: number,
): languages.CompletionItem[] {
  const found = programOf(model);
  if (found === undefined) return [];
  const line = lineNumber - 1;
  const state = found.program.stateBefore(line);
  const block = found.program.block(line);
  const { start, proposals } = proposalsAt(block, column - 1, state, usedVariables(found.lines(), found.offlineNames));
  // A closing dollar sign that the editor has put there is part of what is replaced.
  const closing = block.text[column - 1] === '$' && block.text[start] === '$' ? 1 : 0;
  const range = {
    startLineNumber: lineNumber,
    endLineNumber: lineNumber,
    startColumn: start + 1,
    endColumn: column + closing,
  };
  const { Function: command, Property: letter, Variable: variable } = monaco.languages.CompletionItemKind;
  const kinds: Readonly<Record<Proposal['kind'], languages.CompletionItemKind>> = { command, letter, variable };
  return proposals.map(({ label, insert, about, kind }, at) => ({
    label: { label, description: about },
    kind: kinds[kind],
    insertText: insert,
    filterText: label,
    sortText: String(at).padStart(4, '0'),
    range,
  }));
}

function actionsAt(
  model: editor.ITextModel,
  first: number,
  last: number,
  markers: readonly editor.IMarkerData[],
): languages.CodeAction[] {
  const document = programOf(model);
  if (document === undefined || model.isDisposed()) return [];
  const here = document.found.filter(({ line }) => line + 1 >= first && line + 1 <= last);
  const edit = (edits: Parameters<typeof document.operations>[0]): languages.WorkspaceEdit => ({
    edits: document.operations(edits).map(({ range, text }) => ({
      resource: model.uri,
      versionId: model.getVersionId(),
      textEdit: { range: range, text: text ?? '' },
    })),
  });
  const actions = here.flatMap((found) =>
    fixesOf(document.program, found).map(({ name, values, edits }, at): languages.CodeAction => ({
      title: t(`cnc.fix.${name}`, values),
      kind: 'quickfix',
      isPreferred: at === 0,
      diagnostics: markers.filter(({ code, startColumn }) => code === found.rule && startColumn === found.at + 1),
      edit: edit(edits),
    })),
  );
  if (here.some(({ rule }) => rule === 'sameNumber' || rule === 'blockNumber'))
    actions.push({ title: t('cnc.fix.renumber'), kind: 'quickfix', edit: edit(renumbered(document.lines())) });
  return actions;
}
