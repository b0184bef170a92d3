import { useQuery } from '@tanstack/react-query';
import { ofKind, shaped } from '@/api/objects';
import { objectQuery } from '@/api/queries';

const NONE: readonly string[] = [];

/** Names of the task groups of the task configuration that a task is in. */
export function useGroups(projectId: string, configurationId: string | null): readonly string[] {
  const { data } = useQuery({
    ...objectQuery(projectId, configurationId ?? ''),
    select: (found) => shaped(found, ofKind('task_configuration')).data.groups.map((group) => group.name),
    enabled: configurationId !== null,
  });
  return data ?? NONE;
}
