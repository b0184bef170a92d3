/** Commands of the debugger that need no place in a text; those that do are in `editors/online`. */
import { ArrowDownToDot, ArrowUpFromDot, CircleX, Pause, Play, Redo2, StepForward } from 'lucide-react';
import { contextChanged, menuGroup, registerCommands, type Command, type Enablement } from '../commands';
import { connected, engineer, online, when } from '../conditions';
import type { CommandContext } from '../context';
import { control, removeBreakpoints, setDebugSettings } from './acts';
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

const mayDebug = when(online, connected, engineer);
const mayStep = when(mayDebug, halted);

type Step = Parameters<typeof control>[1];

const moves = (command: Step) => (context: CommandContext) => control(context.online!.runtimeId, command);

const commands: Command[] = [
  ...menuGroup(
    'debug',
    '2_step',
    {
      id: 'debug.continue',
      title: 'debugger.continue',
      icon: Play,
      toolbar: { group: '4_step', order: 1 },
      enabled: mayStep,
      run: moves('continue'),
    },
    {
      id: 'debug.pause',
      title: 'debugger.pause',
      icon: Pause,
      keys: ['Ctrl+Shift+F5'],
      toolbar: { group: '4_step', order: 2 },
      enabled: when(mayDebug, running),
      run: moves('pause'),
    },
    {
      id: 'debug.stepOver',
      title: 'debugger.stepOver',
      icon: Redo2,
      keys: ['F10'],
      toolbar: { group: '4_step', order: 3 },
      enabled: mayStep,
      run: moves('step_over'),
    },
    {
      id: 'debug.stepInto',
      title: 'debugger.stepInto',
      icon: ArrowDownToDot,
      keys: ['F8'],
      toolbar: { group: '4_step', order: 4 },
      enabled: mayStep,
      run: moves('step_into'),
    },
    {
      id: 'debug.stepOut',
      title: 'debugger.stepOut',
      icon: ArrowUpFromDot,
      keys: ['Shift+F10'],
      yieldsKeys: true,
      toolbar: { group: '4_step', order: 5 },
      enabled: mayStep,
      run: moves('step_out'),
    },
    {
      id: 'debug.endCycle',
      title: 'debugger.endCycle',
      icon: StepForward,
      enabled: mayStep,
      run: moves('single_cycle'),
    },
  ),
  {
    id: 'debug.removeBreakpoints',
    title: 'debugger.removeAll',
    icon: CircleX,
    menu: { menu: 'debug', group: '3_breakpoints', order: 9 },
    enabled: when(mayDebug, anyBreakpoint),
    run: (context) => removeBreakpoints(context.online!.runtimeId),
  },
  {
    id: 'debug.safeOutputs',
    title: 'debugger.safeOutputs',
    menu: { menu: 'debug', group: '4_settings', order: 0 },
    enabled: mayDebug,
    checked: (context) => debuggerOf(context)?.state.settings.outputs === 'safe',
    run: async (context) => {
      const settings = debuggerOf(context)?.state.settings;
      if (settings === undefined) return;
      const outputs = settings.outputs === 'safe' ? 'keep' : 'safe';
      await setDebugSettings(context.online!.runtimeId, { ...settings, outputs });
    },
  },
  {
    id: 'debug.haltOthers',
    title: 'debugger.haltOthers',
    menu: { menu: 'debug', group: '4_settings', order: 1 },
    enabled: mayDebug,
    checked: (context) => debuggerOf(context)?.state.settings.other_tasks === 'halt',
    run: async (context) => {
      const settings = debuggerOf(context)?.state.settings;
      if (settings === undefined) return;
      const other_tasks = settings.other_tasks === 'halt' ? 'run' : 'halt';
      await setDebugSettings(context.online!.runtimeId, { ...settings, other_tasks });
    },
  },
];

export function registerDebuggerCommands(): void {
  registerCommands(commands);
  useDebugger.subscribe(contextChanged);
}
