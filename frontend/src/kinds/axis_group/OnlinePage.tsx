import { CircleCheck, CircleOff, OctagonX, RotateCcw } from 'lucide-react';
import { useState } from 'react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { LostBar } from '@/online/LostBar';
import { useLiveNumber, useWatched } from '@/online/useLive';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Facts } from '@/ui/Facts';
import { notifyError } from '@/ui/notices';
import type { OnlineSession } from '@/workbench/onlineSession';
import axisStyles from '../axis/Axis.module.css';
import { ErrorBox } from '../axis/ErrorBox';
import { axisPath, useExists, useShown } from '../axis/live';
import { NotLoggedIn } from '../axis/NotLoggedIn';
import { StateText } from '../axis/StateDiagram';
import { StateDrawing } from '../axis/StateDrawing';
import { Fact } from '../axis/StatusPage';
import { useMotionRefusal } from '../axis/useMotionRefusal';
import styles from './AxisGroup.module.css';
import { groupPath, panelPath } from './live';
import { MEMBERS, PLACES } from './queue';
import { QueueTable } from './QueueTable';

const STATES = {
  GroupErrorStop: { x: 10, y: 14, text: 'axisGroup.state.GroupErrorStop', error: true },
  GroupStopping: { x: 185, y: 14, text: 'axisGroup.state.GroupStopping' },
  GroupHoming: { x: 360, y: 14, text: 'axisGroup.state.GroupHoming' },
  GroupDisabled: { x: 10, y: 120, text: 'axisGroup.state.GroupDisabled' },
  GroupStandby: { x: 185, y: 120, text: 'axisGroup.state.GroupStandby' },
  GroupMoving: { x: 360, y: 120, text: 'axisGroup.state.GroupMoving' },
} as const;
const WAYS = 'M150 138h35M325 138h35M255 50v70M150 50 195 120M360 44 315 120M372 120 318 50';
const GROUP = ['eState', 'iHead', 'iCommands', 'fPathPosition', 'fPathVelocity', 'fPathAcceleration', 'eError'];
const VALUES = ['fSetPosition', 'fActPosition', 'fSetVelocity'] as const;
const AXIS = [...VALUES, 'nAxisState'] as const;
const ACTIONS = [
  { action: 'enable', icon: CircleCheck, text: 'axisGroup.enable' },
  { action: 'disable', icon: CircleOff, text: 'axisGroup.disable' },
  { action: 'reset', icon: RotateCcw, text: 'axisGroup.reset' },
  { action: 'stop', icon: OctagonX, text: 'axisGroup.stop' },
] as const;

interface OnlineProps {
  session: OnlineSession | null;
  name: string;
  /** The axes by their index. */
  axes: readonly string[];
}

/** State, positions and queue of the group, and the acts that need no program (AG-42). */
export function OnlinePage({ session, name, axes }: OnlineProps) {
  const t = useText();
  if (session === null) return <NotLoggedIn text={t('axisGroup.onlineText')} />;
  return <Online session={session} name={name} axes={axes} />;
}

function Online({ session, name, axes }: OnlineProps & { session: OnlineSession }) {
  const t = useText();
  const { runtimeId } = session;
  const group = groupPath(name);
  const panel = panelPath(name);
  const [queue] = useState(() =>
    Array.from({ length: PLACES }, (_, slot) =>
      MEMBERS.map((member) => `${group}.CommandQueue[${slot}].${member}`),
    ).flat(),
  );
  useWatched(runtimeId, [
    ...GROUP.map((member) => `${group}.${member}`),
    `${panel}.eError`,
    `${panel}.ePrepared`,
    ...axes.flatMap((axis) => AXIS.map((member) => `${axisPath(axis)}.${member}`)),
    ...queue,
  ]);
  const state = useShown(runtimeId, `${group}.eState`);
  const exists = useExists(runtimeId, `${group}.eState`);
  const head = useLiveNumber(runtimeId, `${group}.iHead`) ?? 0;
  const commands = useLiveNumber(runtimeId, `${group}.iCommands`) ?? 0;
  if (!exists) return <Empty title={t('axisGroup.notThere')} text={t('axisGroup.notThereText', { name })} />;
  return (
    <div className={form.page} tabIndex={0}>
      <LostBar session={session} />
      <div className={form.inner} data-wide>
        <div className={axisStyles.commissioning}>
          <Section title={t('axis.stateTitle')}>
            <StateDrawing
              places={STATES}
              ways={WAYS}
              height={172}
              label={t('axisGroup.diagram', { state: state ?? '–' })}
              state={state}
            />
            <ErrorBox runtimeId={runtimeId} expression={`${group}.eError`} />
            <ErrorBox runtimeId={runtimeId} expression={`${panel}.ePrepared`} />
          </Section>
          <Section title={t('axisGroup.acts')}>
            <Acts session={session} name={name} />
            <ErrorBox runtimeId={runtimeId} expression={`${panel}.eError`} />
            <Facts>
              <Fact
                text={t('axisGroup.pathPosition')}
                unit="u"
                runtimeId={runtimeId}
                expression={`${group}.fPathPosition`}
              />
              <Fact
                text={t('axisGroup.pathVelocity')}
                unit="u/s"
                runtimeId={runtimeId}
                expression={`${group}.fPathVelocity`}
              />
              <Fact
                text={t('axisGroup.pathAcceleration')}
                unit="u/s²"
                runtimeId={runtimeId}
                expression={`${group}.fPathAcceleration`}
              />
            </Facts>
          </Section>
        </div>
        <Section title={t('axisGroup.positions')}>
          <Positions runtimeId={runtimeId} axes={axes} />
        </Section>
        <Section title={t('axisGroup.queue')}>
          <QueueTable runtimeId={runtimeId} group={group} head={head} commands={commands} />
        </Section>
      </div>
    </div>
  );
}

function Acts({ session, name }: { session: OnlineSession; name: string }) {
  const t = useText();
  const blocked = useMotionRefusal(session);
  const steer = (action: (typeof ACTIONS)[number]['action']) =>
    void api
      .post('/api/v1/runtimes/{runtime_id}/axis_groups/{group}/panel', {
        params: { path: { runtime_id: session.runtimeId, group: name } },
        body: { action },
      })
      .catch(notifyError);
  return (
    <div className={axisStyles.buttons}>
      {ACTIONS.map(({ action, icon, text }) => (
        <Button
          key={action}
          icon={icon}
          variant={action === 'stop' ? 'danger' : 'default'}
          disabledReason={blocked}
          onClick={() => steer(action)}
        >
          {t(text)}
        </Button>
      ))}
    </div>
  );
}

/** The axes by their index: what they are to be and are. */
function Positions({ runtimeId, axes }: { runtimeId: string; axes: readonly string[] }) {
  const t = useText();
  return (
    <div className={styles.scroll}>
      <table className={styles.table}>
        <thead>
          <tr>
            <th>{t('axisGroup.index')}</th>
            <th>{t('axisGroup.axis')}</th>
            <th className={styles.number}>{t('axis.value.setPosition')} [u]</th>
            <th className={styles.number}>{t('axis.value.actPosition')} [u]</th>
            <th className={styles.number}>{t('axis.value.setVelocity')} [u/s]</th>
            <th>{t('axis.stateTitle')}</th>
          </tr>
        </thead>
        <tbody>
          {axes.map((axis, index) => (
            <tr key={index}>
              <td className="digits">{index + 1}</td>
              <td>{axis}</td>
              {VALUES.map((member) => (
                <td key={member} className={`${styles.number} digits`}>
                  <Shown runtimeId={runtimeId} expression={`${axisPath(axis)}.${member}`} />
                </td>
              ))}
              <td>
                <AxisState runtimeId={runtimeId} expression={`${axisPath(axis)}.nAxisState`} />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function AxisState({ runtimeId, expression }: { runtimeId: string; expression: string }) {
  return <StateText state={useShown(runtimeId, expression)} />;
}

function Shown({ runtimeId, expression }: { runtimeId: string; expression: string }) {
  return <>{useShown(runtimeId, expression) ?? '–'}</>;
}
