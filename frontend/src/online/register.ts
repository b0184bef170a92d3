/** Registers the online room: channels follow the logins; panels and commands. */
import { LockKeyhole } from 'lucide-react';
import { useOnline } from '@/workbench/onlineSession';
import { registerBar } from '@/workbench/bars';
import { newExceptions } from '@/workbench/online/exception';
import { registerPanel } from '@/workbench/panels';
import { useProject } from '@/project/openProject';
import { registerValueCommands } from './commands';
import { followSessions } from './connections';
import { registerPastCommands } from './past/commands';
import { followTimeBars, openTimeBar } from './past/store';
import { TimeBar } from './past/TimeBar';
import { registerWatchLists } from './watch/panels';
import { onDemand } from '@/ui/onDemand';

const WatchPanel = onDemand(() => import('./watch/WatchPanel'));
const ForcesPanel = onDemand(() => import('./watch/ForcesPanel'));

function useForceCount() {
  const applicationId = useProject((state) => state.applicationId);
  const count = useOnline((state) => {
    const session = applicationId === null ? undefined : state.sessions[applicationId];
    return session === undefined ? 0 : (state.forces[session.runtimeId] ?? []).length;
  });
  return count === 0 ? null : { text: String(count), tone: 'forced' as const };
}

export function registerOnline(): void {
  registerWatchLists(WatchPanel);
  registerPanel({
    id: 'forces',
    title: 'forces.title',
    icon: LockKeyhole,
    component: ForcesPanel,
    position: 'bottom',
    order: 26,
    initial: true,
    useBadge: useForceCount,
  });

  registerBar(TimeBar);
  registerPastCommands();
  registerValueCommands();
  followSessions();
  followTimeBars();
  followFaults();
}

/** An application that stops with an exception: the way that led there lies open. */
function followFaults(): void {
  useOnline.subscribe(({ sessions }, before) => {
    for (const session of newExceptions(sessions, before.sessions)) {
      // Where nothing is recorded there is nothing to open.
      openTimeBar(session).catch(() => undefined);
    }
  });
}
