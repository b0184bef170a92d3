import { Layers, LogIn, OctagonAlert } from 'lucide-react';
import { useQuery } from '@tanstack/react-query';
import { useDeferredValue, useMemo, useState } from 'react';
import { api } from '@/api/client';
import type { CallFrame, RuntimeException } from '@/api/types';
import { useText } from '@/i18n';
import { HaltedStack } from '../debugger/HaltedStack';
import { useDebugged } from '../debugger/useDebugged';
import type { PastMoment } from '../onlineSession';
import { runCommand } from '../run';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Panel } from '@/ui/Panel';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import styles from './CallStackPanel.module.css';
import { exceptionPlace, exceptionText, exceptionTitle, framePath, isFaultCycle, jumpToFrame } from './exception';
import { waitsForStart } from './runtimeText';
import { useActiveSession } from './session';

/** Where the application stopped with an exception: what happened, who called whom, and the variables of the programs. */
export default function CallStackPanel() {
  const t = useText();
  const session = useActiveSession();
  const looked = useDebugged();
  if (!session)
    return (
      <Empty icon={Layers} title={t('exception.offline')} text={t('exception.offlineText')}>
        <Button icon={LogIn} onClick={() => void runCommand('online.login')}>
          {t('command.login')}
        </Button>
      </Empty>
    );
  const exception = session.runtime?.exception;
  const { past } = session;
  if (!exception && looked?.debugged && looked.debugged.state.halted.length > 0)
    // A cycle in which a task stands has not ended, so it is none of the recorded ones.
    return past ? (
      <NoPastStack cycle={past.cycle} />
    ) : (
      <HaltedStack runtimeId={looked.runtimeId} debugged={looked.debugged} />
    );
  if (!exception) return <Empty icon={Layers} title={t('exception.none')} text={t('exception.noneText')} />;
  return <Report exception={exception} runtimeId={session.runtimeId} past={past} />;
}

/** Instead of the calls of another cycle than the one whose values are shown. */
function NoPastStack({ cycle }: { cycle: number }) {
  const t = useText();
  return <Empty icon={Layers} title={t('exception.noPastStack', { cycle })} text={t('exception.noPastStackText')} />;
}

interface Line {
  key: string;
  frame: CallFrame;
}

interface Value {
  name: string;
  value: string;
}

interface ReportProps {
  exception: RuntimeException;
  runtimeId: string;
  past: PastMoment | null;
}

/** Values of a past cycle by their names; nothing while the present is shown. */
function usePastValues(runtimeId: string, cycle: number | null, names: readonly string[]) {
  const query = useQuery({
    queryKey: ['past values', runtimeId, cycle, names],
    queryFn: async ({ signal }) => {
      const { values } = await api.post('/api/v1/runtimes/{runtime_id}/flight/read', {
        params: { path: { runtime_id: runtimeId } },
        body: { cycle: cycle!, expressions: [...names] },
        signal,
      });
      return Object.fromEntries(names.map((name, at) => [name, values[at]?.literal ?? null]));
    },
    enabled: cycle !== null && names.length > 0,
    placeholderData: (before) => before,
    gcTime: 0,
    retry: false,
  });
  return cycle === null ? undefined : query.data;
}

function Report({ exception, runtimeId, past }: ReportProps) {
  const t = useText();
  const [selected, setSelected] = useState<string | null>('0');
  const [chosen, setChosen] = useState<string | null>(null);
  const lines = useMemo(
    () => exception.call_stack.map((frame, at): Line => ({ key: String(at), frame })),
    [exception.call_stack],
  );
  const values = useMemo(
    () => Object.entries(exception.values).map(([name, value]): Value => ({ name, value })),
    [exception.values],
  );
  const cycle = useDeferredValue(past?.cycle ?? null);
  const names = useMemo(() => Object.keys(exception.values), [exception.values]);
  const then = usePastValues(runtimeId, cycle, names);
  const columns = useMemo(
    (): Column<Line>[] => [
      {
        id: 'pou',
        title: t('exception.pou'),
        width: 160,
        grow: true,
        cell: ({ frame }) => <span className={styles.code}>{frame.pou ?? '?'}</span>,
      },
      {
        id: 'line',
        title: t('exception.lineHead'),
        width: 60,
        align: 'right',
        cell: ({ frame }) => <span className="digits">{frame.line}</span>,
      },
      {
        id: 'object',
        title: t('messages.object'),
        width: 200,
        grow: true,
        hint: ({ frame }) => framePath(frame),
        cell: ({ frame }) => <span>{framePath(frame)}</span>,
      },
    ],
    [t],
  );
  const valueColumns = useMemo(
    (): Column<Value>[] => [
      {
        id: 'name',
        title: t('online.column.expression'),
        width: 180,
        grow: true,
        cell: ({ name }) => <span className={styles.code}>{name}</span>,
      },
      {
        id: 'value',
        title: t('exception.valueThen'),
        width: 140,
        grow: true,
        hint: ({ value }) => value,
        cell: ({ value }) => <span className={styles.code}>{value}</span>,
      },
      ...(cycle === null
        ? []
        : [
            {
              id: 'past',
              title: t('exception.valueInCycle', { cycle }),
              width: 140,
              grow: true,
              hint: ({ name }: Value) => then?.[name] ?? '',
              cell: ({ name }: Value) => <span className={styles.code}>{then?.[name] ?? '–'}</span>,
            },
          ]),
    ],
    [t, cycle, then],
  );
  const text = exceptionText(exception);
  return (
    <Panel>
      <div className={styles.head}>
        <OctagonAlert size={16} aria-hidden />
        <strong>{exceptionTitle(exception)}</strong>
        {text && <span>{text}</span>}
        <span className={styles.place}>{exceptionPlace(exception)}</span>
        <Button variant="quiet" onClick={() => jumpToFrame(exception)}>
          {t('exception.goTo')}
        </Button>
        {waitsForStart(exception) ? (
          <Button variant="quiet" onClick={() => void runCommand('debug.start')}>
            {t('exception.start')}
          </Button>
        ) : (
          <Button variant="quiet" onClick={() => void runCommand('online.reset.warm')}>
            {t('command.reset.warm')}
          </Button>
        )}
      </div>
      <div className={styles.tables}>
        <Table
          label={t('panel.callStack')}
          items={past && !isFaultCycle(past) ? [] : lines}
          columns={columns}
          keyOf={(line) => line.key}
          selected={selected}
          onSelect={(line) => setSelected(line?.key ?? null)}
          onOpen={({ frame }) => jumpToFrame(frame)}
          onShow={({ frame }) => jumpToFrame(frame, false)}
          empty={
            past && lines.length > 0 ? <NoPastStack cycle={past.cycle} /> : <Empty title={t('exception.noStack')} />
          }
        />
        <Table
          label={t('exception.values')}
          items={values}
          columns={valueColumns}
          keyOf={({ name }) => name}
          selected={chosen}
          onSelect={(value) => setChosen(value?.name ?? null)}
          empty={<Empty title={t('exception.noValues')} />}
        />
      </div>
    </Panel>
  );
}
