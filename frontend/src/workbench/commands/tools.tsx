import { KeyRound, Settings, Users } from 'lucide-react';
import { menuGroup, registerCommands, type Command } from '../commands';
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
  ...menuGroup(
    'tools',
    '2_users',
    {
      id: 'tools.password',
      title: 'command.password',
      icon: KeyRound,
      run: async () => {
        await openDialog((close) => <PasswordDialog close={() => close()} />);
      },
    },
    {
      id: 'tools.users',
      title: 'command.users',
      icon: Users,
      enabled: (context) => (context.role === 'admin' ? true : 'reason.admin'),
      run: async () => {
        const { UsersDialog } = await import('../tools/UsersDialog');
        await openDialog((close) => <UsersDialog close={() => close()} />);
      },
    },
  ),
];

export function registerToolsCommands(): void {
  registerCommands(commands);
}
