import { useState } from 'react';
import { useText } from '@/i18n';
import { LostBar } from '@/online/LostBar';
import { useWatched, useFlag } from '@/online/useLive';
import { Empty } from '@/ui/Empty';
import { Facts } from '@/ui/Facts';
import type { OnlineSession } from '@/workbench/onlineSession';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import styles from './Axis.module.css';
import { ControlSection } from './ControlSection';
import { ErrorBox } from './ErrorBox';
import { axisPath, panelPath, useExists, useShown } from './live';
import { isLogical, type AxisSettings } from './model';
import { NotLoggedIn } from './NotLoggedIn';
import { StateDiagram } from './StateDiagram';
import { Fact } from './StatusPage';

const AXIS = ['nAxisState', 'fSetPosition', 'fActPosition', 'fSetVelocity', 'fActVelocity', 'fSetAcceleration'];
const MORE = ['fActAcceleration', 'bRegulatorRealState', 'bError', 'eFailure', 'xHomed'];
const PANEL = ['eState', 'udiHolder', 'xRefused', 'xLost', 'xBusy', 'eError'];

interface CommissioningProps {
  session: OnlineSession | null;
  name: string;
  settings: AxisSettings | undefined;
}

/** State, values and errors of the axis, and moving it by hand. */
export function CommissioningPage({ session, name, settings }: CommissioningProps) {
  const t = useText();
  if (session === null || settings === undefined) return <NotLoggedIn text={t('axis.commissioningText')} />;
  return <Commissioning session={session} name={name} settings={settings} />;
}

function Commissioning({ session, name, settings }: { session: OnlineSession; name: string; settings: AxisSettings }) {
  const t = useText();
  const { runtimeId } = session;
  const axis = axisPath(name);
  const [watched] = useState(() => [
    ...[...AXIS, ...MORE].map((member) => `${axis}.${member}`),
    ...PANEL.map((member) => `${panelPath(name)}.${member}`),
  ]);
  useWatched(runtimeId, watched);
  const state = useShown(runtimeId, `${axis}.nAxisState`);
  const failed = useFlag(runtimeId, `${axis}.bError`);
  const homed = useFlag(runtimeId, `${axis}.xHomed`);
  const exists = useExists(runtimeId, `${axis}.nAxisState`);
  if (!exists) return <Empty title={t('axis.notThere')} text={t('axis.notThereText', { name })} />;
  return (
    <div className={form.page}>
      <LostBar session={session} />
      <div className={form.inner} data-wide>
        <div className={styles.commissioning}>
          <div className={styles.column}>
            <Section title={t('axis.stateTitle')}>
              <StateDiagram state={state} />
              {failed && <ErrorBox runtimeId={runtimeId} expression={`${axis}.eFailure`} />}
            </Section>
            <Section title={t('axis.values')}>
              <Facts>
                <Fact
                  text={t('axis.value.setPosition')}
                  unit="u"
                  runtimeId={runtimeId}
                  expression={`${axis}.fSetPosition`}
                />
                <Fact
                  text={t('axis.value.actPosition')}
                  unit="u"
                  runtimeId={runtimeId}
                  expression={`${axis}.fActPosition`}
                />
                <Fact
                  text={t('axis.value.setVelocity')}
                  unit="u/s"
                  runtimeId={runtimeId}
                  expression={`${axis}.fSetVelocity`}
                />
                <Fact
                  text={t('axis.value.actVelocity')}
                  unit="u/s"
                  runtimeId={runtimeId}
                  expression={`${axis}.fActVelocity`}
                />
                <Fact
                  text={t('axis.value.setAcceleration')}
                  unit="u/s²"
                  runtimeId={runtimeId}
                  expression={`${axis}.fSetAcceleration`}
                />
                <Fact
                  text={t('axis.value.actAcceleration')}
                  unit="u/s²"
                  runtimeId={runtimeId}
                  expression={`${axis}.fActAcceleration`}
                />
                <dt>{t('axis.value.homed')}</dt>
                <dd>{t(homed ? 'axis.value.homedYes' : 'axis.value.homedNo')}</dd>
              </Facts>
            </Section>
          </div>
          {isLogical(settings) ? (
            <p className={form.note}>{t('axis.logical.noControl')}</p>
          ) : (
            <ControlSection session={session} name={name} settings={settings} />
          )}
        </div>
      </div>
    </div>
  );
}
