import { useObjects } from '@/api/queries';
import { useProject } from '@/project/openProject';
import { useSession } from '@/session/session';
import { useRegistry } from './commands';
import { commandContext, type CommandContext } from './context';
import { useOnline } from './onlineSession';
import { useSelection } from './selection';

/** The context for components: draws again when any store that it is made of changes. */
export function useCommandContext(): CommandContext {
  useSession();
  const { projectId } = useProject();
  useSelection();
  useOnline();
  useRegistry((state) => state.version);
  useObjects(projectId);
  return commandContext();
}
