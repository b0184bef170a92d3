import type { DockviewApi } from 'dockview-react';
import { t } from '@/i18n';
import { notify } from '@/ui/notices';
import type { MenuEntry } from '@/ui/Menu';
import { closeEditors } from './close';

const FLOAT_SIZE = { width: 640, height: 420 };

/** Takes a panel out of the docks into a window inside the page. */
export function floatPanel(api: DockviewApi, panelId: string): void {
  const panel = api.getPanel(panelId);
  if (!panel) return;
  api.addFloatingGroup(panel, {
    ...FLOAT_SIZE,
    x: (api.width - FLOAT_SIZE.width) / 2,
    y: Math.max(20, (api.height - FLOAT_SIZE.height) / 3),
  });
}

/** Takes a panel out into a browser window of its own, with the theme of this one. */
export async function popOutPanel(api: DockviewApi, panelId: string): Promise<void> {
  const panel = api.getPanel(panelId);
  if (!panel) return;
  const opened = await api.addPopoutGroup(panel, {
    popoutUrl: '/popout.html',
    onDidOpen: ({ window: popout }) => {
      popout.document.documentElement.dataset.theme = document.documentElement.dataset.theme;
      popout.document.title = panel.title ?? 'Tappet';
    },
  });
  if (!opened) notify({ tone: 'warn', title: t('tab.popOutBlocked'), text: t('tab.popOutBlockedText') });
}

export function splitPanel(api: DockviewApi, panelId: string, direction: 'right' | 'below'): void {
  const panel = api.getPanel(panelId);
  panel?.api.moveTo({ group: panel.group, position: direction === 'right' ? 'right' : 'bottom' });
}

/** The context menu of a tab. */
export function panelEntries(api: DockviewApi, panelId: string): MenuEntry[] {
  const panel = api.getPanel(panelId);
  if (!panel) return [];
  const fellows = panel.group.panels.map((other) => other.id);
  const at = fellows.indexOf(panelId);
  const alone = fellows.length < 2 ? t('reason.onlyTab') : null;
  const docked = panel.api.location.type === 'grid';
  const item = (key: string, text: string, run: () => void, disabledReason?: string | null): MenuEntry => ({
    kind: 'item',
    key,
    text,
    run,
    disabledReason,
  });
  return [
    item('close', t('action.close'), () => void closeEditors([panelId])),
    item('others', t('tab.closeOthers'), () => void closeEditors(fellows.filter((id) => id !== panelId)), alone),
    item(
      'right',
      t('tab.closeRight'),
      () => void closeEditors(fellows.slice(at + 1)),
      at + 1 < fellows.length ? null : t('reason.lastTab'),
    ),
    item('all', t('tab.closeAll'), () => void closeEditors(fellows)),
    { kind: 'line', key: 'line-1' },
    item('split', t('command.splitRight'), () => splitPanel(api, panelId, 'right'), alone),
    item('splitDown', t('command.splitDown'), () => splitPanel(api, panelId, 'below'), alone),
    { kind: 'line', key: 'line-2' },
    docked
      ? item('float', t('command.float'), () => floatPanel(api, panelId))
      : item('dock', t('tab.dock'), () => dockPanel(api, panelId)),
    item('popout', t('command.popOut'), () => void popOutPanel(api, panelId)),
    panel.api.isMaximized()
      ? item('restore', t('tab.restore'), () => panel.api.exitMaximized())
      : item('maximize', t('tab.maximize'), () => panel.api.maximize()),
  ];
}

/** Brings a floating or popped out panel back into the first docked group. */
function dockPanel(api: DockviewApi, panelId: string): void {
  const panel = api.getPanel(panelId);
  const group = api.groups.find((candidate) => candidate.api.location.type === 'grid');
  if (panel && group) panel.api.moveTo({ group, position: 'center' });
}
