import { useQuery } from '@tanstack/react-query';
import { Download, LogIn, ScrollText } from 'lucide-react';
import { useMemo, useState } from 'react';
import type { LogEntry, Severity } from '@/api/types';
import { useText } from '@/i18n';
import { millisecondText } from '../clock';
import { saveBlob } from '../downloadFile';
import { SeverityFilter } from '../messages/SeverityFilter';
import { SeverityIcon } from '../messages/SeverityIcon';
import { isRecording } from '../onlineSession';
import { runCommand } from '../run';
import { useToggleSet } from '@/ui/toggleSet';
import { Button, IconButton } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Panel, PanelBar, PanelRest } from '@/ui/Panel';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { countByLevel, levelOf, logCsv, shownEntries } from './log';
import { logQuery } from './logQuery';
import { useActiveSession } from './session';

/** The runtime's log, newest first. */
export default function LogPanel() {
  const t = useText();
  const session = useActiveSession();
  if (isRecording(session?.runtimeId))
    return <Empty icon={ScrollText} title={t('log.recording')} text={t('log.recordingText')} />;
  if (session)
    return (
      <RuntimeLog
        key={session.runtimeId}
        runtimeId={session.runtimeId}
        since={session.runtime?.since ?? null}
        name={session.runtime?.name ?? 'runtime'}
      />
    );
  return (
    <Empty icon={ScrollText} title={t('log.offline')} text={t('log.offlineText')}>
      <Button icon={LogIn} onClick={() => void runCommand('online.login')}>
        {t('command.login')}
      </Button>
    </Empty>
  );
}

function RuntimeLog({ runtimeId, since, name }: { runtimeId: string; since: string | null; name: string }) {
  const t = useText();
  const [hidden, toggle] = useToggleSet<Severity>();
  const [search, setSearch] = useState('');
  const [selected, setSelected] = useState<string | null>(null);
  const { data, error, refetch } = useQuery(logQuery(runtimeId, since));
  const lines = useMemo(() => shownEntries(data ?? [], hidden, search), [data, hidden, search]);
  const columns = useMemo(
    (): Column<LogEntry>[] => [
      {
        id: 'level',
        title: '',
        width: 30,
        cell: (entry) => <SeverityIcon severity={levelOf(entry.severity)} alone />,
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

  return (
    <Panel>
      <PanelBar>
        <SeverityFilter
          count={countByLevel(data)}
          hidden={hidden}
          toggle={toggle}
          search={search}
          onSearch={setSearch}
        />
        <IconButton
          small
          icon={Download}
          label={t('log.export')}
          disabledReason={lines.length ? null : t('log.empty')}
          onClick={() => saveBlob(new Blob([logCsv(lines)], { type: 'text/csv' }), `${name}-log.csv`)}
        />
      </PanelBar>
      <PanelRest>
        <Table
          label={t('panel.log')}
          items={lines}
          columns={columns}
          keyOf={(entry) => String(entry.id)}
          selected={selected}
          onSelect={(entry) => setSelected(entry && String(entry.id))}
          empty={<Empty title={t(data.length ? 'messages.filtered' : 'log.empty')} />}
        />
      </PanelRest>
    </Panel>
  );
}
