import {
  Binary,
  BrushCleaning,
  CloudUpload,
  Hammer,
  HardDriveDownload,
  LogIn,
  LogOut,
  Play,
  RotateCcw,
  Square,
  StepForward,
  Zap,
} from 'lucide-react';
import { t } from '@/i18n';
import { menuGroup, registerCommands, type Command, type Enablement } from '../commands';
import type { CommandContext } from '../context';
import { application, connected, engineer, idle, online, operator, when } from '../conditions';
import { confirm } from '@/ui/dialogs';
import { stepMessage } from '../messages/jump';
import { presentMessages, useMessages } from '../messages/store';
import {
  build,
  clean,
  createBootApplication,
  download,
  generateCode,
  login,
  logout,
  onlineChange,
  reset,
  runtimeAct,
} from '../online/acts';
import { control } from '../debugger/acts';
import { runCommand } from '../run';
import { waitsForStart } from '../online/runtimeText';

const hasMessages = (): Enablement => {
  const { build: last, live } = useMessages.getState();
  return presentMessages(last, live).some((message) => message.object_id !== null) ? true : 'reason.noMessages';
};

const state = (context: CommandContext) => context.online?.runtime?.state ?? null;
const notRunning = (context: CommandContext): Enablement => {
  if (state(context) === 'run') return 'reason.running';
  return state(context) === 'exception' ? 'reason.exception' : true;
};
const isHalted = (context: CommandContext) => (context.online?.runtime?.halted.length ?? 0) > 0;
/** Past cycles of a program that is under way are shown. */
const looksBack = (context: CommandContext) => context.online?.past != null && state(context) === 'run';
const startable = (context: CommandContext): Enablement =>
  waitsForStart(context.online?.runtime?.exception) || isHalted(context) || looksBack(context)
    ? true
    : notRunning(context);
const running = (context: CommandContext): Enablement => (state(context) === 'stop' ? 'reason.stopped' : true);
const changed = (context: CommandContext): Enablement =>
  context.online?.relation === 'same' && context.dirtyPanels.length === 0 ? 'reason.nothingChanged' : true;

/** What is loaded would be lost from sight: values are shown by the build that was downloaded. */
const loggedOut = (context: CommandContext): Enablement => (context.online ? 'reason.logOutToClean' : true);
/** The controller has the application that is meant. */
const loaded = (context: CommandContext): Enablement =>
  context.online?.relation === 'same' ? true : 'reason.notLoaded';

const changeable = when(online, connected, engineer, changed, idle);

async function askedReset(context: CommandContext, kind: 'warm' | 'cold' | 'origin'): Promise<void> {
  const sure = await confirm({
    title: t(`reset.${kind}.title`),
    text: t(`reset.${kind}.text`),
    action: t(`reset.${kind}.action`),
    danger: true,
  });
  if (sure) await reset(context, kind);
}

const commands: Command[] = [
  {
    id: 'build.build',
    title: 'command.build',
    icon: Hammer,
    keys: ['F11'],
    menu: { menu: 'build', group: '1_build', order: 0 },
    toolbar: { group: '2_online', order: 0 },
    enabled: when(application, engineer, idle),
    run: async (context) => {
      await build(context);
    },
  },
  {
    id: 'build.rebuild',
    title: 'command.rebuild',
    menu: { menu: 'build', group: '1_build', order: 1 },
    enabled: when(application, engineer, idle),
    run: async (context) => {
      await build(context, 'rebuild');
    },
  },
  {
    id: 'build.generateCode',
    title: 'command.generateCode',
    icon: Binary,
    menu: { menu: 'build', group: '1_build', order: 2 },
    enabled: when(application, engineer, idle),
    run: generateCode,
  },
  {
    id: 'build.clean',
    title: 'command.clean',
    icon: BrushCleaning,
    menu: { menu: 'build', group: '1_clean', order: 0 },
    enabled: when(application, engineer, idle, loggedOut),
    run: (context) => clean(context, false),
  },
  {
    id: 'build.cleanAll',
    title: 'command.cleanAll',
    menu: { menu: 'build', group: '1_clean', order: 1 },
    enabled: when(application, engineer, idle, loggedOut),
    run: (context) => clean(context, true),
  },
  ...menuGroup(
    'build',
    '2_messages',
    {
      id: 'build.nextMessage',
      title: 'command.nextMessage',
      keys: ['F4'],
      enabled: hasMessages,
      run: () => stepMessage(1),
    },
    {
      id: 'build.previousMessage',
      title: 'command.previousMessage',
      keys: ['Shift+F4'],
      enabled: hasMessages,
      run: () => stepMessage(-1),
    },
  ),
  ...menuGroup(
    'online',
    '1_session',
    {
      id: 'online.login',
      title: 'command.login',
      icon: LogIn,
      keys: ['Alt+F8'],
      toolbar: { group: '2_online', order: 1 },
      // Whoever presses Login again after a change wants to load it.
      enabled: (context) => (context.online ? changeable(context) : when(application, idle)(context)),
      run: (context) => (context.online ? onlineChange(context, true) : login(context)),
    },
    {
      id: 'online.logout',
      title: 'command.logout',
      icon: LogOut,
      keys: ['Ctrl+F8'],
      toolbar: { group: '2_online', order: 2 },
      enabled: when(online, idle),
      run: logout,
    },
  ),
  ...menuGroup(
    'online',
    '2_load',
    {
      id: 'online.download',
      title: 'command.download',
      icon: CloudUpload,
      toolbar: { group: '2_online', order: 3 },
      enabled: when(online, connected, engineer, idle),
      run: download,
    },
    {
      id: 'online.onlineChange',
      title: 'command.onlineChange',
      icon: Zap,
      keys: ['Alt+Shift+F8'],
      enabled: changeable,
      run: (context) => onlineChange(context),
    },
  ),
  {
    id: 'online.createBootApplication',
    title: 'command.createBootApplication',
    icon: HardDriveDownload,
    menu: { menu: 'online', group: '3_boot' },
    enabled: (context) =>
      context.online ? when(connected, engineer, loaded, idle)(context) : when(application, engineer, idle)(context),
    run: createBootApplication,
  },
  ...(['warm', 'cold', 'origin'] as const).map((kind, at): Command => ({
    id: `online.reset.${kind}`,
    title: `command.reset.${kind}`,
    icon: RotateCcw,
    menu: { menu: 'online', group: '4_reset', order: at },
    enabled: when(online, connected, engineer, idle),
    run: (context) => askedReset(context, kind),
  })),
  ...menuGroup(
    'debug',
    '1_run',
    {
      id: 'debug.start',
      title: 'command.start',
      icon: Play,
      keys: ['F5'],
      toolbar: { group: '3_run', order: 1 },
      enabled: when(online, connected, operator, startable),
      // What stands at a breakpoint goes on, and from a past cycle one comes back to the present.
      run: (context) =>
        looksBack(context)
          ? runCommand('past.toPresent')
          : isHalted(context)
            ? control(context.online!.runtimeId, 'continue')
            : runtimeAct(context, 'start'),
    },
    {
      id: 'debug.stop',
      title: 'command.stop',
      icon: Square,
      keys: ['Shift+F8'],
      toolbar: { group: '3_run', order: 2 },
      enabled: when(online, connected, operator, running),
      run: (context) => runtimeAct(context, 'stop'),
    },
    {
      id: 'debug.singleCycle',
      title: 'command.singleCycle',
      icon: StepForward,
      keys: ['Ctrl+F5'],
      enabled: when(online, connected, operator, notRunning),
      run: (context) => runtimeAct(context, 'single-cycle'),
    },
  ),
];

export function registerOnlineCommands(): void {
  registerCommands(commands);
}
