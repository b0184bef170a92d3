/** Menu entries that every online table offers for its rows. */
import type { KeyboardEvent } from 'react';
import { CircleDotDashed, Copy, Eye, LockKeyhole, PencilLine, Search, Waypoints } from 'lucide-react';
import type { t as Text } from '@/i18n';
import type { OnlineSession } from '@/workbench/onlineSession';
import { runCommand } from '@/workbench/run';
import type { MenuEntry } from '@/ui/Menu';
import { guard } from '@/ui/notices';
import { copyChosen } from './copyRows';
import { breakOnChange, whyNoDataBreakpoint } from './dataBreakpoint';
import { prepare, preparedLiteral } from './prepared';
import { actOnSymbol } from '@/workbench/symbolActs';
import type { OnlineRow } from './treeRows';
import { addEntries, addExpressions } from './watch/ownLists';

/** F12 and Alt+Shift+F12 as in editors. True when the key was one of them. */
export function symbolKey(event: KeyboardEvent, row: OnlineRow | undefined): boolean {
  if (event.key !== 'F12' || event.ctrlKey || event.altKey !== event.shiftKey || !row?.expression) return false;
  event.preventDefault();
  event.stopPropagation();
  actOnSymbol(event.altKey ? 'showCrossReferences' : 'goToDefinition', row.expression);
  return true;
}

export function commonEntries(t: typeof Text, session: OnlineSession | null, rows: readonly OnlineRow[]): MenuEntry[] {
  const expressions = rows.map((row) => row.expression).filter((expression) => expression !== '');
  const none = expressions.length === 0 ? t('watch.selectLine') : null;
  const runtimeId = session?.runtimeId ?? null;
  const prepared = runtimeId !== null && expressions.some((e) => preparedLiteral(runtimeId, e) !== null);
  const offline = runtimeId === null ? t('reason.notLoggedIn') : null;
  const single = expressions.length === 1 ? expressions[0]! : null;
  const one = single === null ? t('watch.selectOneLine') : null;
  return [
    {
      kind: 'item',
      key: 'definition',
      text: t('st.command.goToDefinition'),
      icon: Search,
      shortcut: 'F12',
      disabledReason: one,
      run: () => single !== null && actOnSymbol('goToDefinition', single),
    },
    {
      kind: 'item',
      key: 'crossReferences',
      text: t('st.command.crossReferences'),
      icon: Waypoints,
      shortcut: 'Alt+Shift+F12',
      disabledReason: one,
      run: () => single !== null && actOnSymbol('showCrossReferences', single),
    },
    { kind: 'line', key: 'symbol-line' },
    {
      kind: 'item',
      key: 'write',
      text: t('online.writeValues'),
      icon: PencilLine,
      shortcut: 'Ctrl+F7',
      disabledReason: offline,
      run: () => void runCommand('online.writeValues'),
    },
    {
      kind: 'item',
      key: 'force',
      text: t('online.forceValues'),
      icon: LockKeyhole,
      shortcut: 'F7',
      disabledReason: offline,
      run: () => void runCommand('online.forceValues'),
    },
    {
      kind: 'item',
      key: 'unprepare',
      text: t('online.unprepare'),
      disabledReason: prepared ? null : t('reason.nothingPrepared'),
      run: () => runtimeId !== null && expressions.forEach((expression) => prepare(runtimeId, expression, null)),
    },
    {
      kind: 'item',
      key: 'breakOnChange',
      text: t('debugger.breakOnChange'),
      icon: CircleDotDashed,
      disabledReason: single === null ? one : whyNoDataBreakpoint(runtimeId, single),
      run: () => runtimeId !== null && single !== null && void guard(() => breakOnChange(runtimeId, single)),
    },
    { kind: 'line', key: 'watch-line' },
    {
      kind: 'sub',
      key: 'watch',
      text: t('watch.add'),
      icon: Eye,
      entries: addEntries((list) => addExpressions(expressions, list), none),
    },
    {
      kind: 'item',
      key: 'copyRows',
      text: t('watch.copyWithValues'),
      shortcut: 'Ctrl+C',
      disabledReason: none ?? offline,
      run: () => copyChosen(runtimeId, rows),
    },
    {
      kind: 'item',
      key: 'copy',
      text: t('watch.copy'),
      icon: Copy,
      disabledReason: none,
      run: () => void navigator.clipboard.writeText(expressions.join('\n')),
    },
  ];
}
