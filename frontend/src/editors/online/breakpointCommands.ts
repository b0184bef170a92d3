/** Commands of the debugger that act on the line of the cursor. */
import { ArrowRightToLine, CircleDot, CircleDotDashed, CornerDownRight } from 'lucide-react';
import { mayBreakOnChange } from '@/online/dataBreakpoint';
import { panelPlace } from '@/text/focus';
import { menuGroup, registerCommands, type Command, type Enablement } from '@/workbench/commands';
import { connected, editor, engineer, online, when } from '@/workbench/conditions';
import type { CommandContext } from '@/workbench/context';
import { useDebugger, type LineOf } from '@/workbench/debugger/state';
import {
  editBreakpointAt,
  enableBreakpointAt,
  runToLine,
  setNextStatement,
  toggleBreakpointAt,
} from './breakpointActs';

/** The line of the cursor in the body that is edited; null in declarations and where there are no lines. */
function lineOf({ activeEditor }: CommandContext): { of: LineOf; line: number } | null {
  if (activeEditor === null) return null;
  const place = panelPlace(activeEditor.panelId);
  const line = place?.getPosition()?.lineNumber;
  const uri = place?.getModel()?.uri.path ?? '';
  if (line === undefined || uri.endsWith('/declaration')) return null;
  return { of: { objectId: activeEditor.objectId, part: 'implementation' }, line };
}

const inBody = (context: CommandContext): Enablement =>
  lineOf(context) === null ? 'debugger.reason.noStatement' : true;
const halted = ({ online: session }: CommandContext): Enablement =>
  session !== null && (useDebugger.getState().runtimes[session.runtimeId]?.state.halted.length ?? 0) > 0
    ? true
    : 'debugger.reason.notHalted';

type Act = (runtimeId: string, of: LineOf, line: number) => Promise<void>;

const onLine = (act: Act) => async (context: CommandContext) => {
  const found = lineOf(context);
  if (found !== null && context.online !== null) await act(context.online.runtimeId, found.of, found.line);
};

const mayDebug = when(online, connected, engineer, editor, inBody);

const commands: Command[] = [
  ...menuGroup(
    'debug',
    '3_breakpoints',
    {
      id: 'debug.toggleBreakpoint',
      title: 'debugger.toggle',
      icon: CircleDot,
      keys: ['F9'],
      toolbar: { group: '5_breakpoint', order: 1 },
      enabled: mayDebug,
      run: onLine(toggleBreakpointAt),
    },
    {
      id: 'debug.enableBreakpoint',
      title: 'debugger.toggleEnabled',
      keys: ['Ctrl+F9'],
      enabled: mayDebug,
      run: onLine(enableBreakpointAt),
    },
    {
      id: 'debug.editBreakpoint',
      title: 'debugger.editDialog',
      keys: ['Alt+F9'],
      enabled: mayDebug,
      run: onLine(editBreakpointAt),
    },
    {
      id: 'debug.breakOnChange',
      title: 'debugger.breakOnChange',
      icon: CircleDotDashed,
      delegated: true,
      enabled: mayBreakOnChange,
    },
  ),
  ...menuGroup(
    'debug',
    '2_step_to',
    {
      id: 'debug.runToCursor',
      title: 'debugger.runToCursor',
      icon: ArrowRightToLine,
      keys: ['Ctrl+F10'],
      enabled: mayDebug,
      run: onLine(runToLine),
    },
    {
      id: 'debug.setNextStatement',
      title: 'debugger.setNextStatement',
      icon: CornerDownRight,
      keys: ['Ctrl+Shift+F10'],
      enabled: when(mayDebug, halted),
      run: onLine(setNextStatement),
    },
  ),
];

export function registerBreakpointCommands(): void {
  registerCommands(commands);
}
