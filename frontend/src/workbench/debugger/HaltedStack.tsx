import { Hand } from 'lucide-react';
import { useMemo, useState } from 'react';
import type { Halt, StackFrame } from '@/api/types';
import { useText, type t as text } from '@/i18n';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Select } from '@/ui/Field';
import { guard } from '@/ui/notices';
import { Panel } from '@/ui/Panel';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import styles from '../online/CallStackPanel.module.css';
import { runCommand } from '../run';
import { goToSpot, showFrame, showStack } from './acts';
import own from './Debugger.module.css';
import { FrameVariables } from './FrameVariables';
import type { Debugged } from './state';

/** `Halted at a breakpoint` */
function haltText({ reason, message }: Halt, t: typeof text): string {
  return message ?? t(`debugger.halt.${reason}`);
}

/** Where tasks stand: who called whom, and the variables of the level that is looked at. */
export function HaltedStack({ runtimeId, debugged }: { runtimeId: string; debugged: Debugged }) {
  const t = useText();
  const { state, task, frames, frame } = debugged;
  const [selected, setSelected] = useState<string | null>(null);
  const columns = useMemo(
    (): Column<StackFrame>[] => [
      {
        id: 'pou',
        title: t('exception.pou'),
        width: 160,
        grow: true,
        cell: ({ place }) => <span className={styles.code}>{place.pou}</span>,
      },
      {
        id: 'line',
        title: t('exception.lineHead'),
        width: 60,
        align: 'right',
        cell: ({ place }) => <span className="digits">{place.element ?? place.line}</span>,
      },
      {
        id: 'instance',
        title: t('debugger.instance'),
        width: 200,
        grow: true,
        hint: ({ instance }) => instance ?? '',
        cell: ({ instance }) => <span className={styles.code}>{instance}</span>,
      },
    ],
    [t],
  );
  const halt = state.halted.find((one) => one.task === task) ?? state.halted[0];
  if (halt === undefined) return <Empty title={t('exception.none')} />;
  const look = (shown: StackFrame, focus: boolean) => void guard(() => showFrame(runtimeId, shown, focus));
  const { outputs = 'keep', other_tasks = 'run' } = state.settings;
  return (
    <Panel>
      <div className={`${styles.head} ${own.halted}`}>
        <Hand size={16} aria-hidden />
        <strong>{haltText(halt, t)}</strong>
        {state.halted.length > 1 ? (
          <Select
            label={t('debugger.task')}
            value={halt.task}
            choices={state.halted.map((one) => ({ value: one.task, text: one.task }))}
            compact
            onValue={(chosen) => void guard(() => showStack(runtimeId, chosen))}
          />
        ) : (
          <span>{t('exception.inTask', { task: halt.task })}</span>
        )}
        <span className={styles.place}>{t('debugger.cycle', { cycle: halt.cycle })}</span>
        <span className={own.rule}>
          {t(`debugger.outputs.${outputs}`)} · {t(`debugger.others.${other_tasks}`)}
        </span>
        <Button variant="quiet" onClick={() => goToSpot(halt.place)}>
          {t('exception.goTo')}
        </Button>
        <Button variant="quiet" onClick={() => void runCommand('debug.continue')}>
          {t('debugger.continue')}
        </Button>
      </div>
      <div className={styles.tables}>
        <Table
          label={t('panel.callStack')}
          items={frames}
          columns={columns}
          keyOf={({ index }) => String(index)}
          selected={selected ?? String(frame)}
          onSelect={(shown) => setSelected(shown === null ? null : String(shown.index))}
          onOpen={(shown) => look(shown, true)}
          onShow={(shown) => look(shown, false)}
          empty={<Empty title={t('exception.noStack')} />}
        />
        <FrameVariables runtimeId={runtimeId} variables={debugged.variables} />
      </div>
    </Panel>
  );
}
