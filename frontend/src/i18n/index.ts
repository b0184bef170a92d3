/**
 * Texts of the user interface, English and Chinese.
 *
 * One JSON file per room and language: `en/workbench.json`, `zh/workbench.json` and so on; the folders of kinds and of
 * languages have theirs beside their code and are found by their place. What only the workbench shows comes with it
 * (`workbenchTexts.ts`), so that the first page is small. Flat keys, `{{name}}` for values,
 * `_one`/`_other` suffixes where a count decides (Chinese has `_other` only).
 * `i18n.test.ts` fails on a key that is missing in one language or used nowhere.
 */
import i18next from 'i18next';
import { useSyncExternalStore } from 'react';
import type analysis from './en/analysis.json';
import type bookmarks from './en/bookmarks.json';
import type compare from './en/compare.json';
import type editors from './en/editors.json';
import type exchange from './en/exchange.json';
import type help from './en/help.json';
import type libraries from './en/libraries.json';
import type objects from './en/objects.json';
import type online from './en/online.json';
import type past from './en/past.json';
import type scripts from './en/scripts.json';
import type search from './en/search.json';
import type tests from './en/tests.json';
import type workbench from './en/workbench.json';

export type Language = 'en' | 'zh';

/** The tables of texts; a folder that has one of its own adds its type here by `declare module '@/i18n'`. */
export interface TextTables {
  analysis: typeof analysis;
  bookmarks: typeof bookmarks;
  compare: typeof compare;
  editors: typeof editors;
  exchange: typeof exchange;
  help: typeof help;
  libraries: typeof libraries;
  objects: typeof objects;
  online: typeof online;
  past: typeof past;
  scripts: typeof scripts;
  search: typeof search;
  tests: typeof tests;
  workbench: typeof workbench;
}

type Table = Readonly<Record<string, string>>;
/** Those of every page; `workbenchTexts.ts` has the others. */
const ENGLISH = import.meta.glob<Table>(
  ['./en/{exchange,libraries,objects,online,workbench}.json', '../kinds/*/en.json'],
  {
    eager: true,
    import: 'default',
  },
);

type WithoutPlural<Key> = Key extends `${infer Base}_one` | `${infer Base}_other` ? Base : Key;

/** Every key there is; a misspelt key does not compile. */
export type TextKey = WithoutPlural<{ [Name in keyof TextTables]: keyof TextTables[Name] }[keyof TextTables]>;
export type TextValues = Record<string, string | number>;

void i18next.init({
  lng: 'en',
  fallbackLng: 'en',
  resources: { en: { translation: Object.assign({}, ...Object.values(ENGLISH)) as Table } },
  keySeparator: false,
  nsSeparator: false,
  interpolation: { escapeValue: false },
  initAsync: false,
});

/** Adds English texts of a part of the front end that is fetched later. */
export function addTexts(tables: Readonly<Record<string, Table>>): void {
  for (const table of Object.values(tables)) i18next.addResourceBundle('en', 'translation', table, true, true);
}

/** The text of a key that is built from the name of a kind or language; null where there is none. */
export function textOf(key: string): string | null {
  return i18next.exists(key) ? i18next.t(key) : null;
}

/** Text outside of React (dialog services, commands). Inside components use `useText`, which follows a language switch. */
export function t(key: TextKey, values?: TextValues): string {
  return i18next.t(key, values);
}

/** Names one after the other, as the language of the user lists them. */
export function listed(names: readonly string[]): string {
  return names.join(language() === 'zh' ? '、' : ', ');
}

export function language(): Language {
  return i18next.language === 'zh' ? 'zh' : 'en';
}

let wanted: Language = 'en';

/** Switches the language of everything on screen; the choice is stored by `session/preferences.ts`. */
export async function setLanguage(next: Language): Promise<void> {
  wanted = next;
  if (next === 'zh' && !i18next.hasResourceBundle('zh', 'translation')) {
    const { CHINESE } = await import('./chinese');
    // Another choice may have been made while the texts were fetched.
    if (wanted !== next) return;
    i18next.addResourceBundle('zh', 'translation', CHINESE);
  }
  await i18next.changeLanguage(next);
  document.documentElement.lang = next === 'zh' ? 'zh-CN' : 'en';
}

/** Calls whenever the language changes. Answers the act that ends it. */
export function onLanguageChange(listener: () => void): () => void {
  i18next.on('languageChanged', listener);
  return () => i18next.off('languageChanged', listener);
}

const TEXT_IN: Readonly<Record<Language, typeof t>> = {
  en: (key, values) => i18next.t(key, { ...values, lng: 'en' }),
  zh: (key, values) => i18next.t(key, { ...values, lng: 'zh' }),
};

/**
 * The text function of the language: the component draws again when the language changes. It is another function then,
 * so that what a component remembers with it (columns of a table) is made anew.
 */
export function useText(): typeof t {
  return TEXT_IN[useLanguage()];
}

export function useLanguage(): Language {
  return useSyncExternalStore(onLanguageChange, language);
}
