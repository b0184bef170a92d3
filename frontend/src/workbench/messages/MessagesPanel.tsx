import { CircleCheck, Hammer, ListX } from 'lucide-react';
import { useMemo, useState, type KeyboardEvent } from 'react';
import type { Diagnostic, Severity } from '@/api/types';
import { useText } from '@/i18n';
import { useRegistry } from '../commands';
import { runCommand } from '../run';
import { useToggleSet } from '@/ui/toggleSet';
import { Button, IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { ContextMenu } from '@/ui/Menu';
import { activeDescendant, openMenuAt } from '@/ui/menuKey';
import { Panel, PanelBar, PanelRest } from '@/ui/Panel';
import type { Column } from '@/ui/table';
import { Table } from '@/ui/Table';
import { jumpTo } from './jump';
import { messageEntries } from './messageMenu';
import styles from './Messages.module.css';
import { SeverityFilter } from './SeverityFilter';
import { SeverityIcon } from './SeverityIcon';
import {
  bytesText,
  clearMessages,
  countOf,
  isMended,
  pathParts,
  presentMessages,
  setCurrent,
  useMessages,
} from './store';

const RANK: Record<Severity, number> = { error: 0, warning: 1, info: 2 };

interface Line {
  message: Diagnostic;
  key: string;
}

/** Compiler messages: filters, the table, the outcome of the last build. A click shows the place, Enter or a double click leads there. */
export default function MessagesPanel() {
  const t = useText();
  const { build, live, current } = useMessages();
  const [hidden, toggle] = useToggleSet<Severity>();
  const [search, setSearch] = useState('');
  const all = useMemo(() => presentMessages(build, live), [build, live]);
  const count = useMemo(() => countOf(all), [all]);
  const mended = isMended(build, live);
  const lines = useMemo(() => {
    const wanted = search.trim().toLowerCase();
    return all
      .filter((one) => !hidden.has(one.severity))
      .filter((one) => !wanted || `${one.code} ${one.message} ${one.object_path}`.toLowerCase().includes(wanted))
      .map((message, at): Line => ({ message, key: String(at) }));
  }, [all, hidden, search]);

  const columns: Column<Line>[] = useMemo(
    () => [
      {
        id: 'severity',
        title: '',
        width: 30,
        sort: ({ message: line }) => RANK[line.severity],
        cell: ({ message: line }) => <SeverityIcon severity={line.severity} alone />,
      },
      {
        id: 'code',
        title: t('messages.code'),
        width: 70,
        sort: ({ message: line }) => line.code,
        cell: ({ message: line }) => <span className={styles.code}>{line.code}</span>,
      },
      {
        id: 'message',
        title: t('messages.message'),
        width: 260,
        grow: true,
        sort: ({ message: line }) => line.message,
        hint: ({ message: line }) => [line.message, line.advice].filter(Boolean).join('\n'),
        cell: ({ message: line }) => (
          <span>
            {line.message}
            {line.advice && <span className={styles.advice}> {line.advice}</span>}
          </span>
        ),
      },
      {
        id: 'object',
        title: t('messages.object'),
        width: 320,
        sort: ({ message: line }) => line.object_path,
        hint: ({ message: line }) => line.object_path,
        cell: ({ message: line }) => {
          const { name, place } = pathParts(line.object_path);
          return (
            <span>
              {name}
              {place && <span className={styles.advice}> [{place}]</span>}
            </span>
          );
        },
      },
      {
        id: 'position',
        title: t('messages.position'),
        width: 240,
        cell: ({ message: line }) => <span className="digits">{positionText(line, t)}</span>,
      },
    ],
    [t],
  );

  const entries = () => {
    const line = lines.find(({ message }) => message === current);
    return line === undefined ? [] : messageEntries(line.message, t);
  };
  const onKey = (event: KeyboardEvent, line: Line | undefined) => {
    if (line === undefined || !event.ctrlKey || event.key !== '.') return;
    event.preventDefault();
    openMenuAt(activeDescendant(event.currentTarget));
  };

  return (
    <Panel>
      <PanelBar>
        <SeverityFilter count={count} hidden={hidden} toggle={toggle} search={search} onSearch={setSearch} />
        <IconButton
          small
          icon={ListX}
          label={t('messages.clear')}
          disabledReason={all.length ? null : t('messages.nothingToClear')}
          onClick={clearMessages}
        />
        {build && (
          <span className={styles.summary} data-ok={mended ? undefined : build.report.ok}>
            {mended
              ? t('messages.mended', { name: build.applicationName })
              : summary(build.applicationName, build.report, t)}
          </span>
        )}
      </PanelBar>
      <PanelRest>
        <ContextMenu entries={entries}>
          <div className={styles.rows}>
            <Table
              label={t('panel.messages')}
              items={lines}
              columns={columns}
              keyOf={(line) => line.key}
              selected={lines.find((line) => line.message === current)?.key ?? null}
              onSelect={(line) => setCurrent(line?.message ?? null)}
              onOpen={(line) => jumpTo(line.message)}
              onShow={(line) => jumpTo(line.message, false)}
              onKey={onKey}
              empty={<NoMessages built={build !== null} filtered={all.length > 0} />}
            />
          </div>
        </ContextMenu>
      </PanelRest>
    </Panel>
  );
}

function NoMessages({ built, filtered }: { built: boolean; filtered: boolean }) {
  const t = useText();
  const canBuild = useRegistry((state) => state.commands.has('build.build'));
  if (filtered) return <Empty title={t('messages.filtered')} />;
  if (built) return <Empty icon={CircleCheck} title={t('messages.none')} text={t('messages.noneText')} />;
  return (
    <Empty icon={Hammer} title={t('messages.notBuilt')} text={t('messages.notBuiltText')}>
      {canBuild && <Button onClick={() => void runCommand('build.build')}>{t('command.build')}</Button>}
    </Empty>
  );
}

type Text = ReturnType<typeof useText>;

function positionText(line: Diagnostic, t: Text): string {
  if (line.line === null) return '';
  const place = t('messages.lineColumn', { line: line.line, column: line.column ?? 1 });
  if (!line.part) return place;
  const more = t(line.part === 'declaration' ? 'messages.declaration' : 'messages.implementation');
  return t('text.andMore', { text: place, more });
}

function summary(
  name: string,
  report: { ok: boolean; code_size: number | null; data_size: number | null; seconds: number },
  t: Text,
): string {
  const seconds = report.seconds.toFixed(report.seconds < 10 ? 2 : 1);
  if (!report.ok) return t('messages.buildFailed', { name, seconds });
  return t('messages.buildDone', {
    name,
    seconds,
    code: bytesText(report.code_size ?? 0),
    data: bytesText(report.data_size ?? 0),
  });
}
