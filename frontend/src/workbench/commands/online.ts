import { CloudUpload, Hammer, LogIn, LogOut, Play, RotateCcw, Square, StepForward, Zap } from 'lucide-react';
import { t } from '@/i18n';
import { registerCommands, type Command, type Enablement } from '../commands';
import type { CommandContext } from '../context';
import { confirm } from '@/ui/dialogs';
import { stepMessage } from '../messages/jump';
import { presentMessages, useMessages } from '../messages/store';
import { build, download, login, logout, onlineChange, reset, runtimeAct } from '../online/acts';
import { allOf, atLeast } from '../rights';

const application = (context: CommandContext): Enablement =>
  !context.projectId ? 'reason.noProject' : context.applicationId ? true : 'reason.noApplication';
const idle = (context: CommandContext): Enablement => (context.busy ? 'reason.busy' : true);
const engineer = (context: CommandContext): Enablement =>
  atLeast(context.role, 'engineer') ? true : 'reason.engineer';
const operator = (context: CommandContext): Enablement =>
  atLeast(context.role, 'operator') ? true : 'reason.operator';
const online = (context: CommandContext): Enablement => (context.online ? true : 'reason.notLoggedIn');
const offline = (context: CommandContext): Enablement => (context.online ? 'reason.loggedIn' : true);
const connected = (context: CommandContext): Enablement =>
  context.online?.lostSince != null || context.online?.runtime?.connected === false ? 'reason.connectionLost' : true;
const hasMessages = (): Enablement => {
  const { build: last, live } = useMessages.getState();
  return presentMessages(last, live).some((message) => message.object_id !== null) ? true : 'reason.noMessages';
};

const state = (context: CommandContext) => context.online?.runtime?.state ?? null;
const notRunning = (context: CommandContext): Enablement => {
  if (state(context) === 'run') return 'reason.running';
  return state(context) === 'exception' ? 'reason.exception' : true;
};
const running = (context: CommandContext): Enablement => (state(context) === 'stop' ? 'reason.stopped' : true);
const changed = (context: CommandContext): Enablement =>
  context.online?.relation === 'same' && context.dirtyPanels.length === 0 ? 'reason.nothingChanged' : true;

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
    menu: { menu: 'build', group: '1_build' },
    toolbar: { group: '2_online', order: 0 },
    enabled: (context) => allOf(application(context), engineer(context), idle(context)),
    run: async (context) => {
      await build(context);
    },
  },
  {
    id: 'build.nextMessage',
    title: 'command.nextMessage',
    keys: ['F4'],
    menu: { menu: 'build', group: '2_messages', order: 1 },
    enabled: hasMessages,
    run: () => stepMessage(1),
  },
  {
    id: 'build.previousMessage',
    title: 'command.previousMessage',
    keys: ['Shift+F4'],
    menu: { menu: 'build', group: '2_messages', order: 2 },
    enabled: hasMessages,
    run: () => stepMessage(-1),
  },
  {
    id: 'online.login',
    title: 'command.login',
    icon: LogIn,
    keys: ['Alt+F8'],
    menu: { menu: 'online', group: '1_session', order: 1 },
    toolbar: { group: '2_online', order: 1 },
    enabled: (context) => allOf(application(context), offline(context), idle(context)),
    run: login,
  },
  {
    id: 'online.logout',
    title: 'command.logout',
    icon: LogOut,
    keys: ['Ctrl+F8'],
    menu: { menu: 'online', group: '1_session', order: 2 },
    toolbar: { group: '2_online', order: 2 },
    enabled: (context) => allOf(online(context), idle(context)),
    run: logout,
  },
  {
    id: 'online.download',
    title: 'command.download',
    icon: CloudUpload,
    menu: { menu: 'online', group: '2_load', order: 1 },
    toolbar: { group: '2_online', order: 3 },
    enabled: (context) => allOf(online(context), connected(context), engineer(context), idle(context)),
    run: download,
  },
  {
    id: 'online.onlineChange',
    title: 'command.onlineChange',
    icon: Zap,
    menu: { menu: 'online', group: '2_load', order: 2 },
    enabled: (context) =>
      allOf(online(context), connected(context), engineer(context), changed(context), idle(context)),
    run: onlineChange,
  },
  ...(['warm', 'cold', 'origin'] as const).map((kind, at): Command => ({
    id: `online.reset.${kind}`,
    title: `command.reset.${kind}`,
    icon: RotateCcw,
    menu: { menu: 'online', group: '4_reset', order: at },
    enabled: (context) => allOf(online(context), connected(context), engineer(context), idle(context)),
    run: (context) => askedReset(context, kind),
  })),
  {
    id: 'debug.start',
    title: 'command.start',
    icon: Play,
    keys: ['F5'],
    menu: { menu: 'debug', group: '1_run', order: 1 },
    toolbar: { group: '3_run', order: 1 },
    enabled: (context) => allOf(online(context), connected(context), operator(context), notRunning(context)),
    run: (context) => runtimeAct(context, 'start'),
  },
  {
    id: 'debug.stop',
    title: 'command.stop',
    icon: Square,
    keys: ['Shift+F8'],
    menu: { menu: 'debug', group: '1_run', order: 2 },
    toolbar: { group: '3_run', order: 2 },
    enabled: (context) => allOf(online(context), connected(context), operator(context), running(context)),
    run: (context) => runtimeAct(context, 'stop'),
  },
  {
    id: 'debug.singleCycle',
    title: 'command.singleCycle',
    icon: StepForward,
    keys: ['Ctrl+F5'],
    menu: { menu: 'debug', group: '1_run', order: 3 },
    enabled: (context) => allOf(online(context), connected(context), operator(context), notRunning(context)),
    run: (context) => runtimeAct(context, 'single-cycle'),
  },
];

export function registerOnlineCommands(): void {
  registerCommands(commands);
}
