/**
 * Monaco with the features a PLC programmer uses, and IEC texts.
 *
 * Only this module imports `monaco-editor`; everything else goes through `loadMonaco` and types.
 */
import * as monaco from 'monaco-editor/editor/editor.api';
import EditorWorker from 'monaco-editor/editor/editor.worker?worker';
import 'monaco-editor/features/anchorSelect/register';
import 'monaco-editor/features/bracketMatching/register';
import 'monaco-editor/features/caretOperations/register';
import 'monaco-editor/features/clipboard/register';
import 'monaco-editor/features/codeAction/register';
import 'monaco-editor/features/codeEditor/register';
import 'monaco-editor/features/codicon/register';
import 'monaco-editor/features/comment/register';
import 'monaco-editor/features/cursorUndo/register';
import 'monaco-editor/features/diffEditor/register';
import 'monaco-editor/features/dnd/register';
import 'monaco-editor/features/documentSymbols/register';
import 'monaco-editor/features/find/register';
import 'monaco-editor/features/folding/register';
import 'monaco-editor/features/format/register';
import 'monaco-editor/features/gotoError/register';
import 'monaco-editor/features/gotoLine/register';
import 'monaco-editor/features/gotoSymbol/register';
import 'monaco-editor/features/hover/register';
import 'monaco-editor/features/indentation/register';
import 'monaco-editor/features/lineSelection/register';
import 'monaco-editor/features/linesOperations/register';
import 'monaco-editor/features/longLinesHelper/register';
import 'monaco-editor/features/middleScroll/register';
import 'monaco-editor/features/multicursor/register';
import 'monaco-editor/features/parameterHints/register';
import 'monaco-editor/features/quickOutline/register';
import 'monaco-editor/features/readOnlyMessage/register';
import 'monaco-editor/features/referenceSearch/register';
import 'monaco-editor/features/rename/register';
import 'monaco-editor/features/semanticTokens/register';
import 'monaco-editor/features/smartSelect/register';
import 'monaco-editor/features/snippet/register';
import 'monaco-editor/features/stickyScroll/register';
import 'monaco-editor/features/suggest/register';
import 'monaco-editor/features/tokenization/register';
import 'monaco-editor/features/unicodeHighlighter/register';
import 'monaco-editor/features/wordHighlighter/register';
import 'monaco-editor/features/wordOperations/register';
import 'monaco-editor/features/wordPartOperations/register';
import 'monaco-editor/languages/definitions/javascript/register';
// The feature modules of this Monaco leave out the heart of two features: completion and semantic colours.
import 'monaco-editor/editor/contrib/semanticTokens/browser/documentSemanticTokens';
import 'monaco-editor/editor/contrib/suggest/browser/suggestController';
import { StandaloneServices } from 'monaco-editor/editor/standalone/browser/standaloneServices';
import { releaseKeys } from './editorActions';
import { IEC_TEXT, languageConfiguration, monarchLanguage } from './iecText';
import { partLabels } from './labels';
import { followTheme } from './theme';

self.MonacoEnvironment = { getWorker: () => new EditorWorker() };

// Only before anything else asks for a service.
StandaloneServices.initialize({ labelService: partLabels });
monaco.languages.register({ id: IEC_TEXT, extensions: ['.st'] });
monaco.languages.setLanguageConfiguration(IEC_TEXT, languageConfiguration);
monaco.languages.setMonarchTokensProvider(IEC_TEXT, monarchLanguage);
followTheme(monaco);
releaseKeys(monaco);

export { monaco };
