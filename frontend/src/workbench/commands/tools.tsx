import { KeyRound, Settings, Users } from 'lucide-react';
import { registerCommands, type Command } from '../commands';
import { openDialog } from '@/ui/dialogs';
import { OptionsDialog } from '../tools/OptionsDialog';
import { PasswordDialog } from '../tools/PasswordDialog';

const commands: Command[] = [
  {
    id: 'tools.options',
    title: 'command.options',
    icon: Settings,
    keys: ['Ctrl+,'],
    menu: { menu: 'tools', group: '1_options' },
    run: async () => {
      await openDialog((close) => <OptionsDialog close={() => close()} />);
    },
  },
  {
    id: 'tools.password',
    title: 'command.password',
    icon: KeyRound,
    menu: { menu: 'tools', group: '2_users', order: 1 },
    run: async () => {
      await openDialog((close) => <PasswordDialog close={() => close()} />);
    },
  },
  {
    id: 'tools.users',
    title: 'command.users',
    icon: Users,
    menu: { menu: 'tools', group: '2_users', order: 2 },
    enabled: (context) => (context.role === 'admin' ? true : 'reason.admin'),
    run: async () => {
      const { UsersDialog } = await import('../tools/UsersDialog');
      await openDialog((close) => <UsersDialog close={() => close()} />);
    },
  },
];

export function registerToolsCommands(): void {
  registerCommands(commands);
}
