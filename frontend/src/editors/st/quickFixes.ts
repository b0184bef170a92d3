/** What mends the messages of a place, as entries of a menu: in the table of messages, in the declaration as table. */
import { Lightbulb } from 'lucide-react';
import { titleOfAction, type ServerAction } from '@/lsp/codeActions';
import type { Range } from '@/lsp/protocol';
import { languageClient } from '@/lsp/session';
import { commandContext } from '@/workbench/context';
import { guard } from '@/workbench/notices';
import { mayEdit } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import type { MenuEntry } from '@/workbench/ui/Menu';
import { mend } from './mend';
import { loadMonaco } from './monacoLoader';

interface Wanted {
  /** Only what mends messages of this code. */
  code?: string;
  /** Done before a fix: shows the place. */
  show?: () => void;
}

export async function quickFixEntries(
  projectId: string,
  uri: string,
  range: Range,
  { code, show }: Wanted = {},
): Promise<MenuEntry[]> {
  const monaco = await loadMonaco();
  const params = { textDocument: { uri }, range, context: { diagnostics: [] } };
  const actions = await languageClient(monaco, projectId).request<ServerAction[]>('textDocument/codeAction', params);
  const allowed = mayEdit(commandContext());
  return (actions ?? [])
    .filter((action) => code === undefined || action.diagnostics?.some((one) => one.code === code))
    .map((action, at) => ({
      kind: 'item',
      key: `fix${String(at)}`,
      text: titleOfAction(action),
      icon: Lightbulb,
      disabledReason: allowed === true ? null : reasonText(allowed),
      run: () => {
        show?.();
        void guard(() => mend(monaco, { uri, action }));
      },
    }));
}
