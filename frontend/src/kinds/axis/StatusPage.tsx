import { useText } from '@/i18n';
import { LostBar } from '@/online/LostBar';
import { useWatched } from '@/online/useLive';
import { Facts } from '@/ui/Facts';
import type { OnlineSession } from '@/workbench/onlineSession';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { ErrorBox } from './ErrorBox';
import { axisPath, useShown } from './live';
import { NotLoggedIn } from './NotLoggedIn';

const ROWS = [
  ['axis.status.communication', 'bCommunication'],
  ['axis.status.communicationState', 'wCommunicationState'],
  ['axis.status.driveError', 'dwErrorID'],
  ['axis.status.interfaceError', 'uiDriveInterfaceError'],
  ['axis.status.regulator', 'bRegulatorRealState'],
  ['axis.status.driveStart', 'bDriveStartRealState'],
  ['axis.status.controllerMode', 'byRealControllerMode'],
  ['axis.status.limitActive', 'bSWEndSwitchActive'],
  ['axis.status.cycle', 'fTaskCycle'],
] as const;
const QUEUE = [0, 1, 2, 3, 4];

/** What the drive says, and the errors that function blocks have left (STA-01). */
export function StatusPage({ session, name }: { session: OnlineSession | null; name: string }) {
  const t = useText();
  if (session === null) return <NotLoggedIn text={t('axis.statusText')} />;
  return <Status session={session} name={name} />;
}

function Status({ session, name }: { session: OnlineSession; name: string }) {
  const t = useText();
  const path = axisPath(name);
  const { runtimeId } = session;
  useWatched(runtimeId, [
    ...ROWS.map(([, member]) => `${path}.${member}`),
    ...QUEUE.map((place) => `${path}.fbeFBError[${place}].eErrorID`),
  ]);
  return (
    <div className={form.page} tabIndex={0}>
      <LostBar session={session} />
      <div className={form.inner}>
        <Section title={t('axis.page.status')}>
          <Facts>
            {ROWS.map(([text, member]) => (
              <Fact key={member} text={t(text)} runtimeId={runtimeId} expression={`${path}.${member}`} />
            ))}
          </Facts>
        </Section>
        <Section title={t('axis.errorQueue')}>
          <p className={form.note}>{t('axis.errorQueueText')}</p>
          {QUEUE.map((place) => (
            <ErrorBox key={place} runtimeId={runtimeId} expression={`${path}.fbeFBError[${place}].eErrorID`} />
          ))}
        </Section>
      </div>
    </div>
  );
}

export function Fact({
  text,
  runtimeId,
  expression,
  unit,
}: {
  text: string;
  runtimeId: string;
  expression: string;
  unit?: string;
}) {
  const shown = useShown(runtimeId, expression);
  return (
    <>
      <dt>{text}</dt>
      <dd className="digits">{shown === null ? '–' : `${shown}${unit ? ` ${unit}` : ''}`}</dd>
    </>
  );
}
