/** Quick fixes for Monaco's light bulb and Ctrl+. ; they are applied by `editors/text/applyQuickFix`. */
import type { IDisposable, languages } from 'monaco-editor/editor/editor.api';
import { textLanguages } from '@/text/languages';
import type { Monaco } from '@/text/monacoLoader';
import { t, type TextKey } from '@/i18n';
import type { LanguageClient } from './client';
import { toRange } from './convert';
import type { Diagnostic, WorkspaceEdit } from './protocol';

/** Monaco's command behind each action; its argument is a `ServerAction`. */
export const APPLY_QUICK_FIX = 'tappet.applyQuickFix';

export interface NewMember {
  kind: 'method' | 'property';
  name: string;
  declaration: string;
  accessors: readonly string[];
}

export interface ServerAction {
  title: string;
  kind?: string;
  isPreferred?: boolean;
  diagnostics?: Diagnostic[];
  edit?: WorkspaceEdit;
  data?: {
    key: string;
    values: Readonly<Record<string, string>>;
    declare: { name: string; type: string } | null;
    library: string | null;
    members: { owner: string; items: readonly NewMember[] } | null;
  };
}

/** The server's title in the user's language, where it has the text. */
export function titleOfAction({ title, data }: ServerAction): string {
  if (data === undefined) return title;
  const key = `fix.${data.key}`;
  const text = t(key as TextKey, data.values);
  return text === key ? title : text;
}

export function registerCodeActions(monaco: Monaco, client: LanguageClient): IDisposable {
  return monaco.languages.registerCodeActionProvider(
    textLanguages(),
    {
      provideCodeActions: async (model, range, context, token) => {
        const params = {
          textDocument: { uri: model.uri.toString() },
          range: toRange(range),
          context: { diagnostics: [] },
        };
        const found = await client.request<ServerAction[]>('textDocument/codeAction', params, token);
        const actions = (found ?? []).map((action): languages.CodeAction => {
          const title = titleOfAction(action);
          const codes = new Set(action.diagnostics?.map((diagnostic) => String(diagnostic.code)));
          return {
            title,
            kind: 'quickfix',
            isPreferred: action.isPreferred,
            diagnostics: context.markers.filter((marker) => typeof marker.code === 'string' && codes.has(marker.code)),
            command: { id: APPLY_QUICK_FIX, title, arguments: [{ uri: model.uri.toString(), action }] },
          };
        });
        return { actions, dispose: () => undefined };
      },
    },
    { providedCodeActionKinds: ['quickfix'] },
  );
}
