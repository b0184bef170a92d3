/**
 * Languages of bodies: what a folder `src/editors/<language>` contributes, found by its place.
 *
 * `index.ts` is loaded with the workbench and stays small; `body.ts` is loaded with the first editor of a text. The texts
 * of a language stand beside them in `en.json` and `zh.json`; its name has the key `language.<LANGUAGE>`.
 */
import type { ComponentType } from 'react';
import type { ObjectSummary } from '@/api/types';
import type { EditorProps } from '@/project/editorProps';
import type { Command, Handlers } from '@/workbench/commands';
import type { OptionGroup } from '@/workbench/tools/optionGroups';
import type { TextDocument } from './documents';
import type { OpenText } from './useTextDocument';

export interface LanguageDescriptor {
  /** As the server calls it: ST, IL. */
  language: string;
  commands?: readonly Command[];
  options?: OptionGroup;
}

export type BodyProps = EditorProps & OpenText & { object: ObjectSummary };

/** How a body in the language is shown and edited. */
export interface LanguageBody {
  language: string;
  view: ComponentType<BodyProps>;
  /** Acts for commands, besides those of every text. */
  handlers?: (panelId: string, document: TextDocument) => Handlers;
}
