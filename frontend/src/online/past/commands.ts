/** Commands of the time bar: they open it where it is not there yet. */
import {
  ChevronFirst,
  ChevronLast,
  FastForward,
  History,
  OctagonAlert,
  Play,
  RadioTower,
  Save,
  StepBack,
  StepForward,
} from 'lucide-react';
import { contextChanged, registerCommands, type Command, type Enablement } from '@/workbench/commands';
import { application, connected, engineer, online, there, when, type Condition } from '@/workbench/conditions';
import type { CommandContext } from '@/workbench/context';
import { jumpToFrame } from '@/workbench/online/exception';
import { atLeast } from '@/workbench/rights';
import { saveRecording } from './recordings';
import { closeTimeBar, lookAt, openTimeBar, playToPresent, step, timeBar, togglePlay, useTimeBars } from './store';

/** To look back into a running application its recording has to stop, which is not for everybody. */
const mayOpen: Condition = (context): Enablement => {
  if (timeBar(context.online?.runtimeId) !== null || context.online?.runtime?.state !== 'run') return true;
  return atLeast(context.role, 'operator') ? true : 'reason.operator';
};
const reachable = when(online, there, mayOpen);
const open: Condition = (context) => (timeBar(context.online?.runtimeId) !== null ? true : 'past.notOpen');

const opening = new Map<string, Promise<void>>();

/** Opens the bar where it is closed; answers whether it was open, or about to be: keys repeat faster than it opens. */
async function opened(context: CommandContext): Promise<boolean> {
  const session = context.online!;
  const { runtimeId } = session;
  if (timeBar(runtimeId) !== null) return true;
  const under = opening.get(runtimeId);
  if (under !== undefined) return under.then(() => true);
  const open = openTimeBar(session).finally(() => opening.delete(runtimeId));
  opening.set(runtimeId, open);
  return open.then(() => false);
}

/** Steps; a running application, when the bar opens, shows its last cycle first. */
async function stepBy(context: CommandContext, delta: number): Promise<void> {
  const running = context.online!.runtime?.state === 'run';
  if ((await opened(context)) || !running) await step(context.online!.runtimeId, delta);
}

const onBar = (act: (runtimeId: string) => void | Promise<void>) => (context: CommandContext) =>
  act(context.online!.runtimeId);

export function showFault(context: CommandContext): void {
  const { runtimeId, runtime } = context.online!;
  lookAt(runtimeId, timeBar(runtimeId)!.moments.length - 1);
  if (runtime?.exception) jumpToFrame(runtime.exception);
}

/** Beside the other steps of the debugger, which lead on to later cycles while a past one is shown. */
const stepBack: Command = {
  id: 'past.stepBack',
  title: 'past.stepBack',
  icon: StepBack,
  keys: ['Alt+F10', 'Ctrl+Alt+ArrowLeft'],
  menu: { menu: 'debug', group: '2_step', order: 5.5 },
  toolbar: { group: '4_step', order: 6 },
  enabled: reachable,
  run: (context) => stepBy(context, -1),
};

const bar: Command = {
  id: 'past.bar',
  title: 'past.bar',
  icon: History,
  keys: ['Ctrl+Alt+H'],
  menu: { menu: 'debug', group: '5_past', order: 0 },
  checked: (context) => timeBar(context.online?.runtimeId) !== null,
  enabled: reachable,
  run: async (context) => {
    if (await opened(context)) await closeTimeBar(context.online!.runtimeId);
  },
};

const moves: Omit<Command, 'menu'>[] = [
  {
    id: 'past.stepForward',
    title: 'past.stepForward',
    icon: StepForward,
    keys: ['Ctrl+Alt+ArrowRight'],
    enabled: when(reachable, open),
    run: (context) => stepBy(context, 1),
  },
  {
    id: 'past.first',
    title: 'past.first',
    icon: ChevronFirst,
    keys: ['Ctrl+Alt+Home'],
    enabled: when(reachable, open),
    run: onBar((runtimeId) => lookAt(runtimeId, 0)),
  },
  {
    id: 'past.last',
    title: 'past.last',
    icon: ChevronLast,
    keys: ['Ctrl+Alt+End'],
    enabled: when(reachable, open),
    run: onBar((runtimeId) => lookAt(runtimeId, timeBar(runtimeId)!.moments.length - 1)),
  },
  {
    id: 'past.fault',
    title: 'past.fault',
    icon: OctagonAlert,
    enabled: when(reachable, open, (context) => (context.online?.runtime?.exception ? true : 'past.noFault')),
    run: showFault,
  },
  {
    id: 'past.play',
    title: 'past.play',
    icon: Play,
    keys: ['Ctrl+Alt+Space'],
    checked: (context) => timeBar(context.online?.runtimeId)?.playing != null,
    enabled: when(reachable, open),
    run: onBar((runtimeId) => togglePlay(runtimeId)),
  },
  {
    id: 'past.toPresent',
    title: 'past.toPresent',
    icon: FastForward,
    enabled: when(reachable, open),
    run: onBar(playToPresent),
  },
  {
    id: 'past.save',
    title: 'past.save',
    icon: Save,
    enabled: when(online, connected, engineer, application),
    run: ({ projectId, applicationId, online: session }) =>
      saveRecording(projectId!, applicationId!, session!.runtimeId),
  },
  {
    id: 'past.live',
    title: 'past.live',
    icon: RadioTower,
    enabled: when(online, open),
    run: onBar(closeTimeBar),
  },
];

const commands = moves.map((command, at): Command => ({
  ...command,
  menu: { menu: 'debug', group: '5_past', order: at + 1, submenu: 'past.menu' },
}));

export function registerPastCommands(): void {
  registerCommands([stepBack, bar, ...commands]);
  useTimeBars.subscribe(contextChanged);
}
