/**
 * Languages of bodies: what a folder `src/editors/<language>` contributes, found by its place.
 *
 * `index.ts` is loaded with the workbench and stays small; `body.ts` is loaded with the first editor of a text. The texts
 * of a language stand beside them in `en.json` and `zh.json`; its name has the key `language.<LANGUAGE>`. Nothing else
 * names languages: text models and the language client ask here, editors ask `bodies.ts`.
 */
import type { languages } from 'monaco-editor/editor/editor.api';
import { registerCommands, type Command } from '@/workbench/commands';
import { registerOptionGroup, type OptionGroup } from '@/workbench/tools/optionGroups';
import { IEC_TEXT } from './iecText';

/** How Monaco shows texts of a language that are not coloured as declarations and ST are. */
export interface TextForm {
  /** Monaco's name of the language. */
  id: string;
  /** Loaded with Monaco. */
  tokens: () => Promise<languages.IMonarchLanguage>;
}

export interface LanguageDescriptor {
  /** As the server calls it. */
  language: string;
  commands?: readonly Command[];
  options?: OptionGroup;
  text?: TextForm;
}

const known = new Map<string, LanguageDescriptor>();

/** Makes a language known, with its commands and options. */
export function registerLanguage(descriptor: LanguageDescriptor): void {
  known.set(descriptor.language, descriptor);
  if (descriptor.commands) registerCommands(descriptor.commands);
  if (descriptor.options) registerOptionGroup(descriptor.options);
}

/** Texts with a form of their own. */
export function textForms(): readonly TextForm[] {
  return [...known.values()].flatMap(({ text }) => text ?? []);
}

/** Monaco's languages of the texts that the language server knows. */
export function textLanguages(): string[] {
  return [IEC_TEXT, ...textForms().map(({ id }) => id)];
}

/** Monaco's language of a body. */
export function monacoLanguage(language: string | undefined): string {
  return known.get(language ?? '')?.text?.id ?? IEC_TEXT;
}
