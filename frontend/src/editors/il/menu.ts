import { ClipboardPaste, Copy, ListPlus, MessageSquareOff, Scissors, Tag, Trash2, WandSparkles } from 'lucide-react';
import type { t as Text } from '@/i18n';
import { guard } from '@/ui/notices';
import type { MenuEntry } from '@/ui/Menu';
import { symbolEntries } from '../text/TextMenu';
import type { useIlActs } from './useIlActs';

type Acts = ReturnType<typeof useIlActs>;

/** The clipboard by menu: keys use the browser's own events, which need no permission. */
export const clipboardActs = (acts: Acts) => ({
  cut: () => void guard(() => navigator.clipboard.writeText(acts.cut())),
  copy: () => void guard(() => navigator.clipboard.writeText(acts.copied())),
  paste: () => void guard(async () => acts.paste(await navigator.clipboard.readText())),
});

/** The context menu of the table. */
export function ilMenu(t: typeof Text, acts: Acts, chosen: number): MenuEntry[] {
  const none = chosen === 0 ? t('decl.selectRows') : null;
  const clipboard = clipboardActs(acts);
  return [
    ...(chosen === 0 ? [] : symbolEntries()),
    { kind: 'item', key: 'row', text: t('il.newRow'), icon: ListPlus, shortcut: 'Ctrl+Enter', run: acts.newRow },
    { kind: 'item', key: 'label', text: t('il.newLabel'), icon: Tag, disabledReason: none, run: acts.label },
    { kind: 'line', key: 'l1' },
    {
      kind: 'item',
      key: 'cut',
      text: t('command.cut'),
      icon: Scissors,
      shortcut: 'Ctrl+X',
      disabledReason: none,
      run: clipboard.cut,
    },
    {
      kind: 'item',
      key: 'copy',
      text: t('command.copy'),
      icon: Copy,
      shortcut: 'Ctrl+C',
      disabledReason: none,
      run: clipboard.copy,
    },
    {
      kind: 'item',
      key: 'paste',
      text: t('command.paste'),
      icon: ClipboardPaste,
      shortcut: 'Ctrl+V',
      run: clipboard.paste,
    },
    {
      kind: 'item',
      key: 'delete',
      text: t('il.deleteRows'),
      icon: Trash2,
      shortcut: 'Del',
      danger: true,
      disabledReason: none,
      run: acts.remove,
    },
    { kind: 'line', key: 'l2' },
    { kind: 'item', key: 'negate', text: t('il.negate'), shortcut: 'Alt+N', disabledReason: none, run: acts.negate },
    {
      kind: 'item',
      key: 'network',
      text: t('il.toggleNetwork'),
      icon: MessageSquareOff,
      shortcut: 'Ctrl+O',
      disabledReason: none,
      run: acts.toggleNetwork,
    },
    { kind: 'line', key: 'l3' },
    {
      kind: 'item',
      key: 'assistant',
      text: t('st.command.inputAssistant'),
      icon: WandSparkles,
      shortcut: 'F2',
      disabledReason: none,
      run: () => void acts.assist(),
    },
  ];
}
