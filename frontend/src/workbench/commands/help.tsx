import { CircleHelp, Keyboard } from 'lucide-react';
import { registerCommands, type Command } from '../commands';
import { openDialog } from '@/ui/dialogs';

const commands: Command[] = [
  {
    id: 'help.shortcuts',
    title: 'command.shortcuts',
    icon: Keyboard,
    keys: ['Ctrl+Alt+K'],
    menu: { menu: 'help', group: '1_help' },
    run: async () => {
      const { KeysDialog } = await import('../keymap/KeysDialog');
      await openDialog((close) => <KeysDialog close={() => close()} />);
    },
  },
  {
    id: 'help.about',
    title: 'command.about',
    icon: CircleHelp,
    menu: { menu: 'help', group: '2_about' },
    run: async () => {
      const { AboutDialog } = await import('../help/AboutDialog');
      await openDialog((close) => <AboutDialog close={() => close()} />);
    },
  },
];

export function registerHelpCommands(): void {
  registerCommands(commands);
}
