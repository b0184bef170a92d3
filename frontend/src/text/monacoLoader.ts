/** Monaco is large: it is fetched when the first text editor opens, from our own server, with its texts translated. */
import type * as api from 'monaco-editor/editor/editor.api';
import { loadCodeFont } from './font';
import { languageConfiguration } from './iecText';
import { textForms } from './languages';
import { followLanguage, loadEditorTexts } from './monacoTexts';

export type Monaco = typeof api;

let loading: Promise<Monaco> | null = null;

async function load(): Promise<Monaco> {
  // The editor reads its texts while its modules are evaluated, so the language pack comes first.
  await loadEditorTexts();
  // Monaco measures characters once: what it measures in another font is off when this one comes.
  const [{ monaco }] = await Promise.all([import('./monaco'), loadCodeFont()]);
  await Promise.all(
    textForms().map(async ({ id, tokens }) => {
      monaco.languages.register({ id });
      monaco.languages.setLanguageConfiguration(id, languageConfiguration);
      monaco.languages.setMonarchTokensProvider(id, await tokens());
    }),
  );
  followLanguage();
  return monaco;
}

export function loadMonaco(): Promise<Monaco> {
  loading ??= load().catch((error: unknown) => {
    loading = null;
    throw error;
  });
  return loading;
}
