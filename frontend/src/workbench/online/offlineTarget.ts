/** The controller that a login of the active application would go to, without asking anybody. */
import { shaped } from '@/api/objects';
import { objectQuery, queryClient, runtimesQuery } from '@/api/queries';
import { ofRole } from '@/project/kinds';
import { commandContext } from '../context';
import type { Compared } from './relation';

/** The runtime on the server's own machine; devices in simulation run there. */
export const LOCAL_RUNTIME = 'local';

/** Null while it is logged in, where no controller was chosen, and where that one is not connected. */
export async function offlineTarget(): Promise<Compared | null> {
  const { projectId, applicationId, deviceId, online } = commandContext();
  if (projectId === null || applicationId === null || deviceId === null || online !== null) return null;
  const device = shaped(await queryClient.ensureQueryData(objectQuery(projectId, deviceId)), ofRole('device'));
  const runtimeId = device.data.simulated ? LOCAL_RUNTIME : device.data.runtime_id;
  const runtimes = await queryClient.fetchQuery({ ...runtimesQuery, staleTime: 10_000 });
  const runtime = runtimes.find(({ id }) => id === runtimeId);
  return runtime?.connected ? { applicationId, runtimeId: runtime.id } : null;
}
