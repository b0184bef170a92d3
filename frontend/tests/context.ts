import type { CommandContext } from '@/workbench/context';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { RuntimeState } from '@/api/types';

/** An engineer in a project with an application, logged out, nothing selected. */
export function someContext(changes: Partial<CommandContext> = {}): CommandContext {
  return {
    role: 'engineer',
    projectId: 'p',
    applicationId: 'a',
    deviceId: 'd',
    runtimeId: 'local',
    selection: [],
    activeEditor: null,
    dirtyPanels: [],
    focusedPanel: null,
    online: null,
    busy: false,
    ...changes,
  };
}

/** A login in the given state of the runtime. */
export function someSession(state: RuntimeState['state'], changes: Partial<OnlineSession> = {}): OnlineSession {
  const runtime = { id: 'local', name: 'Local', connected: true, state, halted: [] as string[] } as RuntimeState;
  return {
    applicationId: 'a',
    runtimeId: 'local',
    relation: 'same',
    runtime,
    lostSince: null,
    pacedMs: null,
    past: null,
    ...changes,
  };
}
