import { Command as CommandIcon, FileSearch, Hash, Maximize } from 'lucide-react';
import { menuGroup, registerCommand, registerCommands, type Command } from '../commands';
import { project } from '../conditions';
import { dockApi, showPanel } from '../docking/dock';
import { openPalette } from '../palette/state';
import { allPanels, followPanels, type PanelRegistration } from '../panels';

const commands: Command[] = [
  ...menuGroup(
    'view',
    '9_palette',
    {
      id: 'view.quickOpen',
      title: 'command.quickOpen',
      icon: FileSearch,
      keys: ['Ctrl+P'],
      enabled: project,
      run: () => openPalette('objects'),
    },
    {
      id: 'view.goToSymbol',
      title: 'command.goToSymbol',
      icon: Hash,
      // In a tab of a browser Ctrl+T belongs to the browser; in a window of its own it comes through.
      keys: ['Ctrl+T', 'Ctrl+Alt+T'],
      enabled: project,
      run: () => openPalette('symbols'),
    },
    {
      id: 'view.commandPalette',
      title: 'command.palette',
      icon: CommandIcon,
      keys: ['Ctrl+Shift+P'],
      run: () => openPalette('commands'),
    },
  ),
  {
    id: 'view.fullScreen',
    title: 'command.fullScreen',
    icon: Maximize,
    keys: ['Alt+Enter'],
    menu: { menu: 'view', group: '9_screen' },
    checked: () => document.fullscreenElement !== null,
    run: () => (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen()),
  },
];

/** Shows the panel. */
function panelCommand(panel: PanelRegistration): Command {
  return {
    id: `view.${panel.id}`,
    title: panel.title,
    titleValues: panel.titleValues,
    icon: panel.icon,
    keys: panel.keys,
    menu: {
      menu: 'view',
      group: `${{ left: 1, right: 2, bottom: 3 }[panel.position]}_${panel.position}`,
      order: panel.order,
      submenu: panel.submenu,
    },
    checked: () => dockApi()?.getPanel(panel.id) !== undefined,
    run: () => showPanel(panel.id),
  };
}

/** One command per panel, also for those that come later. */
function followPanelCommands(): void {
  const registered = new Map<PanelRegistration, () => void>();
  const follow = () => {
    const panels = allPanels();
    for (const [panel, dispose] of registered) {
      if (panels.includes(panel)) continue;
      dispose();
      registered.delete(panel);
    }
    for (const panel of panels) if (!registered.has(panel)) registered.set(panel, registerCommand(panelCommand(panel)));
  };
  follow();
  followPanels(follow);
}

export function registerViewCommands(): void {
  registerCommands(commands);
  followPanelCommands();
}
