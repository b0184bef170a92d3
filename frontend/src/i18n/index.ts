/**
 * Texts of the user interface, English and Chinese.
 *
 * One JSON file per room and language: `en/workbench.json`, `zh/workbench.json` and so on, flat keys, `{{name}}` for
 * values, `_one`/`_other` suffixes where a count decides (Chinese has `_other` only). A new room adds its two files to
 * the two tables below. `i18n.test.ts` fails on a key that is missing in one language or used nowhere.
 */
import i18next from 'i18next';
import { useSyncExternalStore } from 'react';
import enAnalysis from './en/analysis.json';
import enEditors from './en/editors.json';
import enIl from './en/il.json';
import enExchange from './en/exchange.json';
import enLibraries from './en/libraries.json';
import enObjects from './en/objects.json';
import enOnline from './en/online.json';
import enScene from './en/scene.json';
import enTests from './en/tests.json';
import enWorkbench from './en/workbench.json';
import zhAnalysis from './zh/analysis.json';
import zhEditors from './zh/editors.json';
import zhIl from './zh/il.json';
import zhExchange from './zh/exchange.json';
import zhLibraries from './zh/libraries.json';
import zhObjects from './zh/objects.json';
import zhOnline from './zh/online.json';
import zhScene from './zh/scene.json';
import zhTests from './zh/tests.json';
import zhWorkbench from './zh/workbench.json';

export type Language = 'en' | 'zh';

const en = {
  ...enWorkbench,
  ...enObjects,
  ...enOnline,
  ...enEditors,
  ...enIl,
  ...enScene,
  ...enTests,
  ...enAnalysis,
  ...enExchange,
  ...enLibraries,
};
const zh = {
  ...zhWorkbench,
  ...zhObjects,
  ...zhOnline,
  ...zhEditors,
  ...zhIl,
  ...zhScene,
  ...zhTests,
  ...zhAnalysis,
  ...zhExchange,
  ...zhLibraries,
};

type WithoutPlural<Key> = Key extends `${infer Base}_one` | `${infer Base}_other` ? Base : Key;

/** Every key there is; a misspelt key does not compile. */
export type TextKey = WithoutPlural<keyof typeof en>;
export type TextValues = Record<string, string | number>;

void i18next.init({
  lng: 'en',
  fallbackLng: 'en',
  resources: { en: { translation: en }, zh: { translation: zh } },
  keySeparator: false,
  nsSeparator: false,
  interpolation: { escapeValue: false },
  initAsync: false,
});

/** Text outside of React (dialog services, commands). Inside components use `useText`, which follows a language switch. */
export function t(key: TextKey, values?: TextValues): string {
  return i18next.t(key, values);
}

export function language(): Language {
  return i18next.language === 'zh' ? 'zh' : 'en';
}

/** Switches the language of everything on screen; the choice is stored by `app/preferences.ts`. */
export async function setLanguage(next: Language): Promise<void> {
  await i18next.changeLanguage(next);
  document.documentElement.lang = next === 'zh' ? 'zh-CN' : 'en';
}

/** Calls whenever the language changes. Answers the act that ends it. */
export function onLanguageChange(listener: () => void): () => void {
  i18next.on('languageChanged', listener);
  return () => i18next.off('languageChanged', listener);
}

/** The text function, bound to the language: the component draws again when the language changes. */
export function useText(): typeof t {
  useSyncExternalStore(onLanguageChange, language);
  return t;
}

export function useLanguage(): Language {
  return useSyncExternalStore(onLanguageChange, language);
}
