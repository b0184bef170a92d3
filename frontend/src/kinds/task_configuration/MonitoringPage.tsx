import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { LoadOfTasks } from '@/api/types';
import { useText } from '@/i18n';
import { TaskTable } from '@/workbench/online/TaskTable';
import { LoadChart } from './LoadChart';
import { joinedLoad } from './monitoring';
import { TimesHistogram } from './TimesHistogram';
import styles from './Monitoring.module.css';

const EVERY_MS = 1000;
/** Samples that the runtime keeps: ten minutes. */
const MOST_SAMPLES = 600;

/** The measured times of the tasks, their load, and histograms of the chosen one (tasks.md, section 5). */
export function MonitoringPage({ runtimeId }: { runtimeId: string }) {
  const t = useText();
  const [selected, setSelected] = useState<string | null>(null);
  const params = { path: { runtime_id: runtimeId } };
  const loadKey = [...keys.tasks(runtimeId), 'load'];
  const { data: load } = useQuery({
    queryKey: loadKey,
    queryFn: async () => {
      const known = queryClient.getQueryData<LoadOfTasks>(loadKey);
      const newest = Date.parse(known?.samples.at(-1)?.at ?? '');
      const fresh = await api.get('/api/v1/runtimes/{runtime_id}/tasks/load', {
        params: { ...params, query: { after_ms: Number.isNaN(newest) ? 0 : newest + 1 } },
      });
      return joinedLoad(known, fresh, MOST_SAMPLES);
    },
    refetchInterval: EVERY_MS,
    retry: false,
  });
  const { data: histograms } = useQuery({
    queryKey: [...keys.tasks(runtimeId), 'histograms'],
    queryFn: () => api.get('/api/v1/runtimes/{runtime_id}/tasks/histograms', { params }),
    refetchInterval: EVERY_MS,
    retry: false,
  });
  const times = histograms?.find((task) => task.name === selected) ?? histograms?.[0];
  return (
    <div className={styles.page}>
      <div className={styles.table} style={{ height: 34 + 29 + Math.min(8, Math.max(2, histograms?.length ?? 2)) * 26 }}>
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
