/** Views of bodies by language: what `body.ts` in the folder of a language exports; see `languages.ts`. */
import type { ComponentType } from 'react';
import type { ObjectSummary } from '@/api/types';
import { codeTokens, type Token } from '@/iec/lexer';
import type { EditorProps } from '@/project/editorProps';
import type { Handlers } from '@/workbench/commands';
import type { TextDocument } from './documents';
import type { OpenText } from './useTextDocument';

export type BodyProps = EditorProps & OpenText & { object: ObjectSummary };

/** How a body in the language is shown and edited. */
export interface LanguageBody {
  language: string;
  view: ComponentType<BodyProps>;
  /** Also shows bodies in languages that have no folder, as text. */
  showsOthers?: boolean;
  /** Acts that change the body, for commands, besides those of every text; while logged in they ask first. */
  handlers?: (panelId: string, document: TextDocument) => Handlers;
  /**
   * The tokens that may stand for values, of a text that begins as the language does; null of any other text.
   * `tokens` are those of the text without comments and pragmas.
   */
  valueTokens?: (text: string, tokens: readonly Token[]) => readonly Token[] | null;
}

const bodies = new Map<string, LanguageBody>();

export function registerBody(body: LanguageBody): void {
  bodies.set(body.language, body);
}

/** View of a body; one in a language without a folder, or in none, is shown as text. */
export function bodyOf(language: string | undefined): LanguageBody {
  const body = bodies.get(language ?? '') ?? [...bodies.values()].find(({ showsOthers }) => showsOthers);
  if (body === undefined) throw new Error('No language shows texts: `registerBodies` has not been called.');
  return body;
}

/** The tokens of a body that may stand for values: what is none, its language tells. */
export function valueTokens(text: string): readonly Token[] {
  const tokens = codeTokens(text);
  for (const body of bodies.values()) {
    const own = body.valueTokens?.(text, tokens);
    if (own != null) return own;
  }
  return tokens;
}
