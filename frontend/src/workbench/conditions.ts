/** What must hold for commands to run: `enabled: when(online, connected, engineer)`. */
import type { Enablement } from './commands';
import type { CommandContext } from './context';
import { isRecording } from './onlineSession';
import { atLeast } from './rights';

export type Condition = (context: CommandContext) => Enablement;

/** All of the conditions; what the first of them that does not hold says is the reason. */
export function when(...conditions: readonly Condition[]): Condition {
  return (context) => {
    for (const condition of conditions) {
      const held = condition(context);
      if (held !== true) return held;
    }
    return true;
  };
}

export const engineer: Condition = ({ role }) => (atLeast(role, 'engineer') ? true : 'reason.engineer');
export const operator: Condition = ({ role }) => (atLeast(role, 'operator') ? true : 'reason.operator');

export const project: Condition = ({ projectId }) => (projectId ? true : 'reason.noProject');
export const application: Condition = when(project, ({ applicationId }) =>
  applicationId ? true : 'reason.noApplication',
);
export const selection: Condition = ({ selection: { length } }) => (length > 0 ? true : 'reason.nothingSelected');
export const editor: Condition = ({ activeEditor }) => (activeEditor ? true : 'reason.noEditor');
/** No build, login or download is under way. */
export const idle: Condition = ({ busy }) => (busy ? 'reason.busy' : true);

/** Values are those of now: nothing is written while one looks at others. */
export const live: Condition = (context) => (context.online?.past != null ? 'reason.past' : true);

export const online: Condition = (context) => (context.online ? true : 'reason.notLoggedIn');
/** What one is logged in to answers, be it a controller or a recording. */
export const there: Condition = (context) =>
  context.online?.lostSince != null || context.online?.runtime?.connected === false ? 'reason.connectionLost' : true;
/** A controller that one is logged in to answers. */
export const connected: Condition = (context) =>
  isRecording(context.online?.runtimeId) ? 'reason.recording' : there(context);
