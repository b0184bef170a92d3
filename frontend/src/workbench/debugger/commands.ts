/** Commands of the debugger that need no place in a text; those that do are in `editors/online`. */
import {
  ArrowDownToDot,
  ArrowUpFromDot,
  CircleCheck,
  CircleSlash,
  CircleX,
  Pause,
  Play,
  Redo2,
  StepForward,
  Workflow,
} from 'lucide-react';
import { contextChanged, menuGroup, registerCommands, type Command, type Enablement } from '../commands';
import { connected, engineer, live, online, when } from '../conditions';
import type { CommandContext } from '../context';
import type { TextKey } from '@/i18n';
import { runCommand } from '../run';
import { control, enableBreakpoints, removeBreakpoints, setDebugSettings, type DebugSettings } from './acts';
import { hasFlow, switchFlow, useFlow } from './flow';
import { useDebugger } from './state';

const debuggerOf = ({ online: session }: CommandContext) =>
  session === null ? undefined : useDebugger.getState().runtimes[session.runtimeId];

const halted = (context: CommandContext): Enablement =>
  (context.online?.runtime?.halted.length ?? 0) > 0 || (debuggerOf(context)?.state.halted.length ?? 0) > 0
    ? true
    : 'debugger.reason.notHalted';
const running = (context: CommandContext): Enablement => {
  if (context.online?.runtime?.state !== 'run') return 'reason.stopped';
  return halted(context) === true ? 'debugger.reason.halted' : true;
};
const anyBreakpoint = (context: CommandContext): Enablement =>
  (debuggerOf(context)?.state.breakpoints.length ?? 0) > 0 ? true : 'debugger.reason.noBreakpoint';

/** Some breakpoint that is not yet as all are to be. */
const anyOther =
  (enabled: boolean) =>
  (context: CommandContext): Enablement =>
    debuggerOf(context)?.state.breakpoints.some(({ order }) => (order.enabled ?? true) !== enabled) === true
      ? true
      : enabled
        ? 'debugger.reason.allEnabled'
        : 'debugger.reason.allDisabled';

const mayDebug = when(online, connected, engineer);
const mayStep = when(mayDebug, halted);
const inPast = ({ online: session }: CommandContext) => session?.past != null;

type Step = Parameters<typeof control>[1];

const moves = (command: Step) => (context: CommandContext) => control(context.online!.runtimeId, command);

/** While a past cycle is shown, to go on means to go on to later ones, by a command of the time bar. */
function movesAlso(command: Step, inThePast: string): Pick<Command, 'enabled' | 'run'> {
  return {
    enabled: (context) => inPast(context) || mayStep(context),
    run: (context) => (inPast(context) ? runCommand(inThePast) : moves(command)(context)),
  };
}

const hasFlowControl = (context: CommandContext) => context.online !== null && hasFlow(context.online.runtimeId);

/** A setting of the debugger that is on or off. */
function setting<Name extends keyof DebugSettings>(
  id: string,
  title: TextKey,
  name: Name,
  off: DebugSettings[Name],
  on: DebugSettings[Name],
): Omit<Command, 'menu'> {
  const settingsOf = (context: CommandContext) => debuggerOf(context)?.state.settings;
  const isOn = (context: CommandContext) => settingsOf(context)?.[name] === on;
  return {
    id,
    title,
    enabled: mayDebug,
    checked: isOn,
    run: async (context) => {
      const settings = settingsOf(context);
      if (settings === undefined) return;
      await setDebugSettings(context.online!.runtimeId, { ...settings, [name]: isOn(context) ? off : on });
    },
  };
}

const commands: Command[] = [
  ...menuGroup(
    'debug',
    '2_step',
    {
      id: 'debug.continue',
      title: 'debugger.continue',
      icon: Play,
      toolbar: { group: '4_step', order: 1 },
      ...movesAlso('continue', 'past.toPresent'),
    },
    {
      id: 'debug.pause',
      title: 'debugger.pause',
      icon: Pause,
      keys: ['Ctrl+Shift+F5'],
      toolbar: { group: '4_step', order: 2 },
      enabled: when(mayDebug, running, live),
      run: moves('pause'),
    },
    {
      id: 'debug.stepOver',
      title: 'debugger.stepOver',
      icon: Redo2,
      keys: ['F10'],
      toolbar: { group: '4_step', order: 3 },
      ...movesAlso('step_over', 'past.stepForward'),
    },
    {
      id: 'debug.stepInto',
      title: 'debugger.stepInto',
      icon: ArrowDownToDot,
      keys: ['F8'],
      toolbar: { group: '4_step', order: 4 },
      ...movesAlso('step_into', 'past.stepForward'),
    },
    {
      id: 'debug.stepOut',
      title: 'debugger.stepOut',
      icon: ArrowUpFromDot,
      keys: ['Shift+F10'],
      yieldsKeys: true,
      toolbar: { group: '4_step', order: 5 },
      enabled: when(mayStep, live),
      run: moves('step_out'),
    },
    {
      id: 'debug.endCycle',
      title: 'debugger.endCycle',
      icon: StepForward,
      enabled: when(mayStep, live),
      run: moves('single_cycle'),
    },
  ),
  {
    id: 'debug.enableBreakpoints',
    title: 'debugger.enableAll',
    icon: CircleCheck,
    keys: ['Ctrl+Shift+F9'],
    menu: { menu: 'debug', group: '3_breakpoints_all', order: 1 },
    enabled: when(mayDebug, anyBreakpoint, anyOther(true)),
    run: (context) => enableBreakpoints(context.online!.runtimeId, true),
  },
  {
    id: 'debug.disableBreakpoints',
    title: 'debugger.disableAll',
    icon: CircleSlash,
    keys: ['Alt+Shift+F9'],
    menu: { menu: 'debug', group: '3_breakpoints_all', order: 2 },
    enabled: when(mayDebug, anyBreakpoint, anyOther(false)),
    run: (context) => enableBreakpoints(context.online!.runtimeId, false),
  },
  {
    id: 'debug.removeBreakpoints',
    title: 'debugger.removeAll',
    icon: CircleX,
    menu: { menu: 'debug', group: '3_breakpoints_all', order: 3 },
    enabled: when(mayDebug, anyBreakpoint),
    run: (context) => removeBreakpoints(context.online!.runtimeId),
  },
  ...menuGroup(
    'debug',
    '4_settings',
    {
      id: 'debug.flowControl',
      title: 'debugger.flowControl',
      icon: Workflow,
      checked: hasFlowControl,
      // What is on can be switched off, whatever may have happened since.
      enabled: (context) => hasFlowControl(context) || when(mayDebug, live)(context),
      run: (context) => switchFlow(context.online!.runtimeId, !hasFlowControl(context)),
    },
    setting('debug.safeOutputs', 'debugger.safeOutputs', 'outputs', 'keep', 'safe'),
    setting('debug.haltOthers', 'debugger.haltOthers', 'other_tasks', 'run', 'halt'),
  ),
];

export function registerDebuggerCommands(): void {
  registerCommands(commands);
  useDebugger.subscribe(contextChanged);
  useFlow.subscribe((now, before) => {
    if (Object.keys(now.runtimes).join() !== Object.keys(before.runtimes).join()) contextChanged();
  });
}
