/** Help: the panel, and F1 for what stands at the cursor. */
import { BookOpenText, CircleHelp } from 'lucide-react';
import { onDemand } from '@/ui/onDemand';
import { registerCommand } from '@/workbench/commands';
import { registerPanel } from '@/workbench/panels';
import { helpHere } from './context';

export function registerHelp(): void {
  registerPanel({
    id: 'help',
    title: 'help.title',
    icon: BookOpenText,
    component: onDemand(() => import('./HelpPanel')),
    position: 'right',
    order: 50,
  });
  registerCommand({
    id: 'help.here',
    title: 'command.help',
    icon: CircleHelp,
    keys: ['F1'],
    menu: { menu: 'help', group: '0_here' },
    run: helpHere,
  });
}
