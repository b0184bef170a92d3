import { CircleDot, CirclePlus, CornerDownRight, LogIn, Pencil, Trash2, TriangleAlert } from 'lucide-react';
import { useMemo, useState, type ReactNode } from 'react';
import { useObjects } from '@/api/queries';
import type { Breakpoint } from '@/api/types';
import { useText, type t as text } from '@/i18n';
import { useProject } from '@/project/openProject';
import { objectPath } from '@/project/tree';
import { Button, IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { ContextMenu, type MenuEntry } from '@/ui/Menu';
import { guard } from '@/ui/notices';
import { Panel, PanelBar, PanelRest } from '@/ui/Panel';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { useRegistry } from '../commands';
import { commandContext } from '../context';
import { entriesOf } from '../frame/menuEntries';
import { runCommand } from '../run';
import { useCommandContext } from '../useCommandContext';
import { changeBreakpoint, goToSpot, removeBreakpoint } from './acts';
import { editBreakpoint, newDataBreakpoint } from './BreakpointDialog';
import styles from './Debugger.module.css';
import { lookOf } from './state';
import { useDebugged } from './useDebugged';

/** `hit 3 times, halts at every 10th` */
function hitsText({ order: { hits } }: Breakpoint, t: typeof text): string {
  const mode = hits?.mode ?? 'always';
  return mode === 'always' ? '' : t(`debugger.hits.${mode}`, { count: hits?.count ?? 1 });
}

const FOR_ALL = ['debug.enableBreakpoints', 'debug.disableBreakpoints', 'debug.removeBreakpoints'];

const isEnabled = ({ order }: Breakpoint) => order.enabled ?? true;

function enable(runtimeId: string, one: Breakpoint, enabled: boolean): void {
  void guard(() => changeBreakpoint(runtimeId, one.id, { ...one.order, enabled }));
}

/** All breakpoints of the controller: they are the same for everybody who is logged in to it. */
export default function BreakpointsPanel() {
  const t = useText();
  const projectId = useProject((state) => state.projectId);
  const { data: objects } = useObjects(projectId);
  const looked = useDebugged();
  const context = useCommandContext();
  const commands = useRegistry((state) => state.commands);
  const [selected, setSelected] = useState<string | null>(null);
  const runtimeId = looked?.runtimeId;
  const breakpoints = looked?.debugged?.state.breakpoints ?? [];
  const columns = useMemo((): Column<Breakpoint>[] => {
    const place = ({ order, actual }: Breakpoint) => {
      if (order.kind === 'data') return order.expression ?? '';
      const spot = actual ?? order.place;
      const path = spot?.object_id ? objectPath(objects ?? [], spot.object_id) : (actual?.uri ?? '');
      return t('debugger.place', { path, line: spot?.element ?? spot?.line ?? '?' });
    };
    const limits = ({ order }: Breakpoint) => [order.instance, order.task].filter(Boolean).join(', ');
    const code = (shown: string): ReactNode => <span className={styles.code}>{shown}</span>;
    return [
      {
        id: 'enabled',
        title: '',
        width: 56,
        cell: (one) => (
          <span style={{ display: 'inline-flex', alignItems: 'center', gap: 8 }}>
            <input
              type="checkbox"
              className={styles.box}
              aria-label={t('debugger.enabled')}
              checked={isEnabled(one)}
              onChange={(event) => runtimeId !== undefined && enable(runtimeId, one, event.target.checked)}
            />
            <span className={styles.dot} data-look={lookOf(one)} aria-hidden />
          </span>
        ),
      },
      {
        id: 'place',
        title: t('debugger.column.place'),
        width: 240,
        grow: true,
        hint: place,
        cell: (one) => code(place(one)),
        sort: place,
      },
      {
        id: 'condition',
        title: t('debugger.column.condition'),
        width: 160,
        grow: true,
        hint: ({ order }) => order.condition ?? '',
        cell: ({ order }) => code(order.condition ?? ''),
      },
      {
        id: 'hits',
        title: t('debugger.column.hits'),
        width: 240,
        hint: (one) => hitsText(one, t),
        cell: (one) => (
          <span>
            <span className="digits">{one.hit_count}</span> <span className={styles.dim}>{hitsText(one, t)}</span>
          </span>
        ),
        sort: (one) => one.hit_count,
      },
      { id: 'limits', title: t('debugger.column.limits'), width: 160, hint: limits, cell: (one) => code(limits(one)) },
      {
        id: 'log',
        title: t('debugger.column.log'),
        width: 160,
        grow: true,
        hint: ({ order }) => order.log ?? '',
        cell: ({ order }) => code(order.log ?? ''),
      },
      {
        id: 'state',
        title: t('debugger.column.state'),
        width: 180,
        grow: true,
        hint: ({ reason }) => reason ?? '',
        cell: ({ verified, reason }) =>
          verified ? null : (
            <span className={styles.dim} style={{ display: 'inline-flex', alignItems: 'center', gap: 4 }}>
              <TriangleAlert size={14} aria-hidden />
              {reason}
            </span>
          ),
      },
    ];
  }, [t, objects, runtimeId]);
  if (looked === null || runtimeId === undefined)
    return (
      <Empty icon={CircleDot} title={t('exception.offline')} text={t('debugger.offlineText')}>
        <Button icon={LogIn} onClick={() => void runCommand('online.login')}>
          {t('command.login')}
        </Button>
      </Empty>
    );
  const chosen = breakpoints.find(({ id }) => String(id) === selected);
  const noChoice = chosen === undefined ? t('debugger.chooseOne') : null;
  const remove = (one: Breakpoint) => void guard(() => removeBreakpoint(runtimeId, one.id));
  const go = (one: Breakpoint, focus: boolean) => {
    if (one.actual) goToSpot(one.actual, focus);
    else if (one.order.place?.line != null)
      goToSpot(
        { ...one.order.place, pou: '', uri: '', line: one.order.place.line, end_line: one.order.place.line },
        focus,
      );
  };
  const entries = (): MenuEntry[] => {
    if (chosen === undefined) return entriesOf(FOR_ALL, commands, commandContext());
    const turned = !isEnabled(chosen);
    return [
      {
        kind: 'item',
        key: 'go',
        text: t('debugger.goTo'),
        icon: CornerDownRight,
        shortcut: t('messages.enterKey'),
        disabledReason: chosen.order.kind === 'data' ? t('debugger.reason.noPlace') : null,
        run: () => go(chosen, true),
      },
      {
        kind: 'item',
        key: 'edit',
        text: t('debugger.editDialog'),
        icon: Pencil,
        shortcut: 'F2',
        run: () => void editBreakpoint(runtimeId, chosen),
      },
      {
        kind: 'item',
        key: 'enable',
        text: t(turned ? 'debugger.enable' : 'debugger.disable'),
        shortcut: t('debugger.spaceKey'),
        run: () => enable(runtimeId, chosen, turned),
      },
      {
        kind: 'item',
        key: 'remove',
        text: t('debugger.remove'),
        icon: Trash2,
        shortcut: 'Del',
        run: () => remove(chosen),
      },
      { kind: 'line', key: 'all' },
      ...entriesOf(FOR_ALL, commands, commandContext()),
    ];
  };
  return (
    <Panel>
      <PanelBar>
        <IconButton
          small
          icon={CirclePlus}
          label={t('debugger.newData')}
          onClick={() => void newDataBreakpoint(runtimeId)}
        />
        <IconButton
          small
          icon={Pencil}
          label={t('debugger.edit')}
          disabledReason={noChoice}
          onClick={() => chosen && void editBreakpoint(runtimeId, chosen)}
        />
        <IconButton
          small
          icon={Trash2}
          label={t('debugger.remove')}
          disabledReason={noChoice}
          onClick={() => chosen && remove(chosen)}
        />
        {entriesOf(FOR_ALL, commands, context).map(
          (entry) =>
            entry.kind === 'item' &&
            entry.icon && (
              <IconButton
                key={entry.key}
                small
                icon={entry.icon}
                label={entry.text}
                shortcut={entry.shortcut}
                disabledReason={entry.disabledReason}
                onClick={entry.run}
              />
            ),
        )}
      </PanelBar>
      <ContextMenu entries={entries}>
        <PanelRest>
          <Table
            label={t('panel.breakpoints')}
            items={breakpoints}
            columns={columns}
            keyOf={({ id }) => String(id)}
            selected={selected}
            onSelect={(one) => setSelected(one === null ? null : String(one.id))}
            onOpen={(one) => go(one, true)}
            onShow={(one) => go(one, false)}
            onKey={(event, one) => {
              if (event.key === 'Delete' && one) remove(one);
              else if (event.key === 'F2' && one) void editBreakpoint(runtimeId, one);
              else if (event.key === ' ' && one) {
                event.preventDefault();
                enable(runtimeId, one, !isEnabled(one));
              }
            }}
            empty={<Empty icon={CircleDot} title={t('debugger.none')} text={t('debugger.noneText')} />}
          />
        </PanelRest>
      </ContextMenu>
    </Panel>
  );
}
