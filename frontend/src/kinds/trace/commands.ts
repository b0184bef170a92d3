/** Commands of traces (TRC-05); there only while a trace is what commands act on. */
import { activeHandler, useRegistry, type Command } from '@/workbench/commands';
import { ACT_GROUPS } from './acts';

export const commands: readonly Command[] = ACT_GROUPS.flatMap((group, number) =>
  group.map((act, order) => ({
    id: act.id,
    title: act.id,
    ...('icon' in act && { icon: act.icon }),
    delegated: true,
    visible: (context) => activeHandler(act.id, context, useRegistry.getState().handlers) !== undefined,
    menu: { menu: 'online' as const, group: `8_trace`, order: number * 20 + order, submenu: 'trace.menu' as const },
  })),
);
