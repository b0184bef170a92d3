/** What can be done with a message: its quick fixes, going to its place, copying it. */
import { BellOff, Copy, CornerDownRight } from 'lucide-react';
import type { Diagnostic } from '@/api/types';
import type { useText } from '@/i18n';
import type { MenuEntry } from '@/ui/Menu';
import { jumpTo } from './jump';
import { canBeSwitchedOff, refusedToSwitchOff, switchOff } from './notReported';
import { quickFixesOf } from './quickFixes';

export async function messageEntries(message: Diagnostic, t: ReturnType<typeof useText>): Promise<MenuEntry[]> {
  const fixes = await quickFixesOf(message, () => jumpTo(message));
  return [
    ...fixes,
    ...(fixes.length > 0 ? [{ kind: 'line', key: 'fixes' } as const] : []),
    {
      kind: 'item',
      key: 'open',
      text: t('messages.goTo'),
      icon: CornerDownRight,
      shortcut: t('messages.enterKey'),
      disabledReason: message.object_id === null ? t('messages.noPlace') : null,
      run: () => jumpTo(message),
    },
    {
      kind: 'item',
      key: 'copy',
      text: t('messages.copy'),
      icon: Copy,
      run: () => void navigator.clipboard.writeText(messageText(message)),
    },
    ...(canBeSwitchedOff(message)
      ? [
          {
            kind: 'item',
            key: 'notReported',
            text: t('warnings.doNotReport', { code: message.code }),
            icon: BellOff,
            disabledReason: refusedToSwitchOff(message),
            run: () => void switchOff(message),
          } as const,
        ]
      : []),
  ];
}

/** `Application.PLC_PRG:3:5: error E0201: Identifier 'x' not defined. Declare it.` */
function messageText({ severity, code, message, advice, object_path, line, column }: Diagnostic): string {
  const place = line === null ? object_path : `${object_path}:${String(line)}:${String(column ?? 1)}`;
  return `${place}: ${severity} ${code}: ${[message, advice].filter(Boolean).join('. ')}`;
}
