import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { api } from '@/api/client';
import { keys } from '@/api/queries';
import { useText } from '@/i18n';
import { TaskTable } from '@/workbench/online/TaskTable';
import { LoadChart } from './LoadChart';
import { TimesHistogram } from './TimesHistogram';
import styles from './Monitoring.module.css';
import { useLoad } from './useLoad';

const EVERY_MS = 1000;

/** The measured times of the tasks, their load, and histograms of the chosen one (tasks.md, section 5). */
export function MonitoringPage({ runtimeId }: { runtimeId: string }) {
  const t = useText();
  const [selected, setSelected] = useState<string | null>(null);
  const { data: load } = useLoad(runtimeId);
  const { data: histograms } = useQuery({
    queryKey: [...keys.tasks(runtimeId), 'histograms'],
    queryFn: () =>
      api.get('/api/v1/runtimes/{runtime_id}/tasks/histograms', { params: { path: { runtime_id: runtimeId } } }),
    refetchInterval: EVERY_MS,
    retry: false,
  });
  const times = histograms?.find((task) => task.name === selected) ?? histograms?.[0];
  return (
    <div className={styles.page}>
      <div
        className={styles.table}
        style={{ height: 34 + 29 + Math.min(8, Math.max(2, histograms?.length ?? 2)) * 26 }}
      >
        <TaskTable runtimeId={runtimeId} selected={times?.name ?? null} onSelected={setSelected} />
      </div>
      <div className={styles.charts}>
        <LoadChart load={load} />
        <TimesHistogram
          title={t('taskConfiguration.durations', { name: times?.name ?? '–' })}
          times={times}
          what="cycles"
        />
        <TimesHistogram
          title={t('taskConfiguration.jitters', { name: times?.name ?? '–' })}
          times={times}
          what="starts"
        />
      </div>
    </div>
  );
}
