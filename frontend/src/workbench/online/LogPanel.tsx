import { useQuery } from '@tanstack/react-query';
import { CircleX, Download, Info, LogIn, ScrollText, TriangleAlert } from 'lucide-react';
import { useMemo, useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { LogEntry } from '@/api/types';
import { useText } from '@/i18n';
import { millisecondText } from '../clock';
import { saveBlob } from '../downloadFile';
import messages from '../messages/Messages.module.css';
import { runCommand } from '../run';
import { Button, IconButton } from '../ui/Button';
import { Empty, Failed, Loading } from '../ui/Empty';
import { TextInput } from '../ui/Field';
import { FilterToggle } from '../ui/FilterToggle';
import { Table } from '../ui/Table';
import type { Column } from '../ui/table';
import { levelOf, logCsv, merged, shownEntries, type LogLevel } from './log';
import { useActiveSession } from './session';

const POLL_MS = 2000;
const ICONS = { error: CircleX, warning: TriangleAlert, info: Info };
const LEVELS: readonly LogLevel[] = ['error', 'warning', 'info'];

/** The runtime's log, newest first. */
export default function LogPanel() {
  const t = useText();
  const session = useActiveSession();
  if (session)
    return (
      <RuntimeLog key={session.runtimeId} runtimeId={session.runtimeId} name={session.runtime?.name ?? 'runtime'} />
    );
  return (
    <Empty icon={ScrollText} title={t('log.offline')} text={t('log.offlineText')}>
      <Button icon={LogIn} onClick={() => void runCommand('online.login')}>
        {t('command.login')}
      </Button>
    </Empty>
  );
}

function RuntimeLog({ runtimeId, name }: { runtimeId: string; name: string }) {
  const t = useText();
  const [hidden, setHidden] = useState<ReadonlySet<LogLevel>>(new Set());
  const [search, setSearch] = useState('');
  const [selected, setSelected] = useState<string | null>(null);
  const { data, error, refetch } = useQuery({
    queryKey: keys.log(runtimeId),
    queryFn: async () => {
      const known = queryClient.getQueryData<LogEntry[]>(keys.log(runtimeId)) ?? [];
      return merged(
        known,
        await api.get<LogEntry[]>(`/runtimes/${runtimeId}/log`, { query: { since: known.at(-1)?.id ?? 0 } }),
      );
    },
    refetchInterval: POLL_MS,
    retry: false,
  });
  const lines = useMemo(() => shownEntries(data ?? [], hidden, search), [data, hidden, search]);
  const columns = useMemo(
    (): Column<LogEntry>[] => [
      {
        id: 'level',
        title: '',
        width: 30,
        cell: (entry) => {
          const level = levelOf(entry.severity);
          const Icon = ICONS[level];
          return <Icon size={15} className={messages[level]} aria-label={t(`severity.${level}`)} />;
        },
      },
      {
        id: 'at',
        title: t('log.time'),
        width: 200,
        cell: (entry) => <span className="digits">{millisecondText(entry.at)}</span>,
      },
      {
        id: 'message',
        title: t('log.message'),
        width: 300,
        grow: true,
        hint: (entry) => entry.message,
        cell: (entry) => <span>{entry.message}</span>,
      },
      { id: 'component', title: t('log.component'), width: 140, cell: (entry) => <span>{entry.component}</span> },
    ],
    [t],
  );
  if (error && !data) return <Failed error={error} retry={() => void refetch()} />;
  if (!data) return <Loading />;

  const toggle = (level: LogLevel) => {
    const next = new Set(hidden);
    if (!next.delete(level)) next.add(level);
    setHidden(next);
  };

  return (
    <div className={messages.view}>
      <div className={messages.bar}>
        {LEVELS.map((level) => {
          const Icon = ICONS[level];
          return (
            <FilterToggle key={level} shown={!hidden.has(level)} onToggle={() => toggle(level)}>
              <Icon size={14} className={messages[level]} aria-hidden />
              {t(`messages.${level}`, { count: data.filter((entry) => levelOf(entry.severity) === level).length })}
            </FilterToggle>
          );
        })}
        <TextInput
          className={messages.search}
          value={search}
          onValue={setSearch}
          placeholder={t('messages.search')}
          aria-label={t('messages.search')}
        />
        <IconButton
          small
          icon={Download}
          label={t('log.export')}
          disabledReason={lines.length ? null : t('log.empty')}
          onClick={() => saveBlob(new Blob([logCsv(lines)], { type: 'text/csv' }), `${name}-log.csv`)}
        />
      </div>
      <div className={messages.table}>
        <Table
          label={t('panel.log')}
          items={lines}
          columns={columns}
          keyOf={(entry) => String(entry.id)}
          selected={selected}
          onSelect={(entry) => setSelected(entry && String(entry.id))}
          empty={<Empty title={t(data.length ? 'messages.filtered' : 'log.empty')} />}
        />
      </div>
    </div>
  );
}
