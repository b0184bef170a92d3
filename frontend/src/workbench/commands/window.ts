import {
  ArrowLeftToLine,
  ArrowRightToLine,
  Columns2,
  ExternalLink,
  PanelsTopLeft,
  PictureInPicture2,
  Rows2,
  X,
} from 'lucide-react';
import { menuGroup, registerCommands, type Command, type Enablement } from '../commands';
import { editor } from '../conditions';
import type { CommandContext } from '../context';
import { stepArea } from '../areas';
import { closeEditors } from '../docking/close';
import { dockApi, focusPanel, resetLayout } from '../docking/dock';
import { floatPanel, popOutPanel, splitPanel } from '../docking/panelMenu';
import { useSelection } from '../selection';

/** The panel that the Window commands act on: the focused one, else the active editor. */
function target(context: CommandContext): string | null {
  return context.focusedPanel ?? context.activeEditor?.panelId ?? null;
}

const somePanel = (context: CommandContext): Enablement => (target(context) ? true : 'reason.noEditor');

const severalInGroup = (context: CommandContext): Enablement => {
  const id = target(context);
  const group = id ? dockApi()?.getPanel(id)?.group : undefined;
  return group && group.panels.length > 1 ? true : 'reason.onlyTab';
};

function step(by: 1 | -1): void {
  const { editors, activeEditor } = useSelection.getState();
  const at = editors.findIndex((editor) => editor.panelId === activeEditor);
  const next = editors[(at + by + editors.length) % editors.length];
  const panel = next && dockApi()?.getPanel(next.panelId);
  if (!panel) return;
  panel.api.setActive();
  focusPanel(panel);
}

const commands: Command[] = [
  ...menuGroup(
    'window',
    '1_go',
    {
      id: 'window.nextArea',
      title: 'command.nextArea',
      keys: ['F6'],
      run: () => stepArea(1),
    },
    {
      id: 'window.previousArea',
      title: 'command.previousArea',
      keys: ['Shift+F6'],
      run: () => stepArea(-1),
    },
    {
      id: 'window.next',
      title: 'command.nextEditor',
      icon: ArrowRightToLine,
      keys: ['Ctrl+F6', 'Alt+PageDown'],
      enabled: editor,
      run: () => step(1),
    },
    {
      id: 'window.previous',
      title: 'command.previousEditor',
      icon: ArrowLeftToLine,
      keys: ['Ctrl+Shift+F6', 'Alt+PageUp'],
      enabled: editor,
      run: () => step(-1),
    },
  ),
  ...menuGroup(
    'window',
    '2_close',
    {
      id: 'window.close',
      title: 'command.closeEditor',
      icon: X,
      // In a tab of a browser Ctrl+F4 belongs to the browser; in a window of its own it comes through.
      keys: ['Alt+W', 'Ctrl+F4'],
      enabled: editor,
      run: async (context) => {
        await closeEditors([context.activeEditor!.panelId]);
      },
    },
    {
      id: 'window.closeAll',
      title: 'command.closeAllEditors',
      enabled: editor,
      run: async () => {
        await closeEditors(useSelection.getState().editors.map((editor) => editor.panelId));
      },
    },
  ),
  ...menuGroup(
    'window',
    '3_place',
    {
      id: 'window.splitRight',
      title: 'command.splitRight',
      icon: Columns2,
      keys: ['Ctrl+\\'],
      enabled: severalInGroup,
      run: (context) => act(context, (api, id) => splitPanel(api, id, 'right')),
    },
    {
      id: 'window.splitDown',
      title: 'command.splitDown',
      icon: Rows2,
      enabled: severalInGroup,
      run: (context) => act(context, (api, id) => splitPanel(api, id, 'below')),
    },
    {
      id: 'window.float',
      title: 'command.float',
      icon: PictureInPicture2,
      enabled: somePanel,
      run: (context) => act(context, floatPanel),
    },
    {
      id: 'window.popOut',
      title: 'command.popOut',
      icon: ExternalLink,
      enabled: somePanel,
      run: (context) => act(context, popOutPanel),
    },
  ),
  {
    id: 'window.resetLayout',
    title: 'command.resetLayout',
    icon: PanelsTopLeft,
    menu: { menu: 'window', group: '4_layout' },
    run: () => resetLayout(),
  },
];

function act(
  context: CommandContext,
  run: (api: NonNullable<ReturnType<typeof dockApi>>, id: string) => void | Promise<void>,
): void | Promise<void> {
  const api = dockApi();
  const id = target(context);
  return api && id ? run(api, id) : undefined;
}

export function registerWindowCommands(): void {
  registerCommands(commands);
}
