import { useQuery } from '@tanstack/react-query';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { useObjectSession } from '@/online/useObjectSession';
import { ToneDot } from '@/workbench/online/ToneDot';
import { tracesQuery } from './data/useRuns';
import styles from './RunningMark.module.css';

/** That the controller records a trace: green behind its name in the tree (TRC-71). */
export function RunningMark({ projectId, object }: { projectId: string; object: ObjectSummary }) {
  const t = useText();
  const session = useObjectSession(projectId, object);
  const { data } = useQuery({
    ...tracesQuery(session?.runtimeId ?? ''),
    enabled: session !== null && session.lostSince === null,
  });
  const name = object.name.toLowerCase();
  const own = session === null ? undefined : data?.find((one) => one.name.toLowerCase() === name);
  if (!own?.running) return null;
  return (
    <span className={styles.mark}>
      <ToneDot tone="running" />
      {` ${t('trace.active')}`}
    </span>
  );
}
