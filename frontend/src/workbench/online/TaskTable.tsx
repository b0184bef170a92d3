import { Timer, RotateCcw } from 'lucide-react';
import { useMemo } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { TaskState } from '@/api/types';
import { useText } from '@/i18n';
import { commandContext } from '../context';
import { guard } from '@/ui/notices';
import { atLeast } from '../rights';
import { Button } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { ContextMenu } from '@/ui/Menu';
import { Panel, PanelRest } from '@/ui/Panel';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { MONITORING_MS, useTasks } from './poll';
import styles from './TaskTable.module.css';
import { countText, microsNumber } from './times';

const STATUS_COLORS: Record<string, string> = { exception: 'var(--error)', halted: 'var(--warn)', valid: 'var(--ok)' };

interface TaskTableProps {
  runtimeId: string;
  /** Name of the chosen task. */
  selected: string | null;
  onSelected: (name: string | null) => void;
}

/** Statistics of the tasks as CODESYS lists them (TASK-50 to TASK-59); reset by button or context menu. */
export function TaskTable({ runtimeId, selected, onSelected }: TaskTableProps) {
  const t = useText();
  const { data, error, refetch } = useTasks(runtimeId, MONITORING_MS);
  const operator = atLeast(commandContext().role, 'operator') ? null : t('reason.operator');

  const columns = useMemo((): Column<TaskState>[] => {
    const number = (
      id: string,
      title: string,
      value: (task: TaskState) => number | null,
      width = 84,
    ): Column<TaskState> => ({
      id,
      title,
      width,
      align: 'right',
      sort: (task) => value(task) ?? -1,
      cell: (task) => <span>{microsNumber(value(task))}</span>,
    });
    return [
      {
        id: 'name',
        title: t('tasks.task'),
        width: 140,
        grow: true,
        sort: (task) => task.name,
        cell: (task) => <span>{task.name}</span>,
      },
      {
        id: 'status',
        title: t('tasks.status'),
        width: 100,
        sort: (task) => task.status ?? '',
        cell: (task) => (
          <span style={{ color: STATUS_COLORS[task.status ?? ''] }}>{statusText(task.status ?? '', t)}</span>
        ),
      },
      {
        id: 'priority',
        title: t('tasks.priority'),
        width: 70,
        align: 'right',
        sort: (task) => task.priority ?? 99,
        cell: (task) => <span>{task.priority ?? '–'}</span>,
      },
      {
        id: 'interval',
        title: t('tasks.interval'),
        width: 96,
        align: 'right',
        sort: (task) => task.interval_us ?? 0,
        cell: (task) => <span>{task.interval_us ?? '–'}</span>,
      },
      {
        id: 'iecCycles',
        title: t('tasks.iecCycles'),
        width: 110,
        align: 'right',
        sort: (task) => task.iec_cycles,
        cell: (task) => <span>{countText(task.iec_cycles)}</span>,
      },
      {
        id: 'cycles',
        title: t('tasks.cycles'),
        width: 110,
        align: 'right',
        sort: (task) => task.cycles,
        cell: (task) => <span>{countText(task.cycles)}</span>,
      },
      number('last', t('tasks.last'), (task) => task.last_us),
      number('mean', t('tasks.mean'), (task) => task.average_us),
      number('max', t('tasks.max'), (task) => task.max_us),
      number('min', t('tasks.min'), (task) => task.min_us),
      number('jitter', t('tasks.jitter'), (task) => task.jitter_us),
      number('minJitter', t('tasks.minJitter'), (task) => task.min_jitter_us, 104),
      number('maxJitter', t('tasks.maxJitter'), (task) => task.max_jitter_us, 104),
      {
        id: 'overruns',
        title: t('tasks.overruns'),
        width: 84,
        align: 'right',
        sort: (task) => task.overruns ?? 0,
        cell: (task) => <span>{task.overruns ?? '–'}</span>,
      },
    ];
  }, [t]);

  if (error) return <Failed error={error} retry={() => void refetch()} />;
  if (!data) return <Loading />;
  if (data.length === 0) return <Empty icon={Timer} title={t('tasks.none')} text={t('tasks.noneText')} />;

  const reset = (names: readonly string[]) =>
    void guard(async () => {
      await Promise.all(
        names.map((task) =>
          api.post('/api/v1/runtimes/{runtime_id}/tasks/{task}/reset', {
            params: { path: { runtime_id: runtimeId, task } },
          }),
        ),
      );
      await queryClient.invalidateQueries({ queryKey: keys.tasks(runtimeId) });
    });

  return (
    <Panel>
      <div className={styles.bar}>
        <Button
          variant="quiet"
          icon={RotateCcw}
          disabledReason={operator}
          onClick={() => reset(data.map((task) => task.name))}
        >
          {t('tasks.resetAll')}
        </Button>
        <span className={styles.note}>{t('tasks.microseconds')}</span>
      </div>
      <ContextMenu
        entries={() =>
          selected
            ? [
                {
                  kind: 'item',
                  key: 'reset',
                  text: t('tasks.reset', { name: selected }),
                  icon: RotateCcw,
                  disabledReason: operator,
                  run: () => reset([selected]),
                },
              ]
            : []
        }
      >
        <PanelRest>
          <Table
            label={t('panel.tasks')}
            items={data}
            columns={columns}
            keyOf={(task) => task.name}
            selected={selected}
            onSelect={(task) => onSelected(task?.name ?? null)}
          />
        </PanelRest>
      </ContextMenu>
    </Panel>
  );
}

const STATUSES = ['not_created', 'created', 'valid', 'halted', 'exception'] as const;

/** TASK-51 in the user's language; a word of a newer runtime stays as it is. */
function statusText(status: string, t: ReturnType<typeof useText>): string {
  const known = STATUSES.find((one) => one === status.toLowerCase().replace(' ', '_'));
  return known ? t(`tasks.status.${known}`) : status;
}
