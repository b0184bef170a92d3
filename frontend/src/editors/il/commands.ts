/** Commands of bodies in IL; there only while such a body is what commands act on (spec 6: CMD-03, CMD-21). */
import { activeHandler, useRegistry, type Command } from '@/workbench/commands';
import type { CommandContext } from '@/workbench/context';
import { mayChangeText } from '@/workbench/rights';

const offered = (id: string) => (context: CommandContext) =>
  activeHandler(id, context, useRegistry.getState().handlers) !== undefined;

export const ilCommands: readonly Command[] = [
  {
    id: 'il.negate',
    title: 'il.negate',
    // Browsers keep Ctrl+N for a new window; where they hand it on, it works as well.
    keys: ['Alt+N', 'Ctrl+N'],
    scope: 'editor',
    delegated: true,
    visible: offered('il.negate'),
    enabled: mayChangeText,
    menu: { menu: 'edit', group: '7_il', order: 1 },
  },
  {
    id: 'il.toggleNetwork',
    title: 'il.toggleNetwork',
    keys: ['Ctrl+O'],
    scope: 'editor',
    delegated: true,
    visible: offered('il.toggleNetwork'),
    enabled: mayChangeText,
    menu: { menu: 'edit', group: '7_il', order: 2 },
  },
];
