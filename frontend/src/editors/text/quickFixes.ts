/** Quick fixes for the messages of a place, as entries of a menu: in the table of messages, in the declaration as table. */
import { Lightbulb } from 'lucide-react';
import type { Diagnostic } from '@/api/types';
import { useProject } from '@/project/openProject';
import { parsePartUri, partUri } from '@/project/partUri';
import { titleOfAction, type ServerAction } from '@/lsp/codeActions';
import type { Range } from '@/lsp/protocol';
import { languageClient } from '@/lsp/session';
import { commandContext } from '@/workbench/context';
import { guard } from '@/ui/notices';
import { mayChangeText } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import type { MenuEntry } from '@/ui/Menu';
import { applyQuickFix } from './applyQuickFix';
import { mayChangeNow } from './onlineEdit';
import { loadMonaco } from '@/text/monacoLoader';

interface Wanted {
  /** Only quick fixes for messages of this code. */
  code?: string;
  /** Done before a fix: shows the place. */
  show?: () => void;
}

/** Quick fixes of a message, found again at its place. */
export async function quickFixesOfMessage(message: Diagnostic, show: () => void): Promise<MenuEntry[]> {
  const { projectId } = useProject.getState();
  const { object_id, part, line, column, end_line, end_column, code } = message;
  if (projectId === null || object_id === null || part === null || line === null) return [];
  const start = { line: line - 1, character: (column ?? 1) - 1 };
  const end = end_line === null ? start : { line: end_line - 1, character: (end_column ?? 1) - 1 };
  return quickFixEntries(projectId, partUri(projectId, object_id, part), { start, end }, { code, show });
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
  const allowed = mayChangeText(commandContext());
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
        void guard(async () => {
          const address = parsePartUri(uri);
          if (address === null || !(await mayChangeNow(projectId, address.objectId))) return;
          await applyQuickFix(monaco, { uri, action });
        });
      },
    }));
}
