/** The questions before something happens to a machine. */
import { useState } from 'react';
import type { LoginAnswer, RuntimeState } from '@/api/types';
import { t, useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { FormDialog } from '@/ui/FormDialog';
import { Checkbox } from '@/ui/Field';
import { RadioCards } from '@/ui/RadioCards';
import styles from './dialogs.module.css';
import { RuntimeDialog } from './RuntimeDialog';

export interface LoginChoice {
  how: 'online_change' | 'download' | 'without';
  /** After a download: start at once. */
  start: boolean;
}

interface LoginQuestion {
  answer: LoginAnswer;
  application: string;
  runtime: RuntimeState;
  /** Whether this user may download; others only look. */
  mayLoad: boolean;
}

export function askLogin(question: LoginQuestion): Promise<LoginChoice | undefined> {
  return openDialog<LoginChoice>((close) => <LoginDialog {...question} close={close} />);
}

export function askDownload(application: string, running: boolean): Promise<{ start: boolean } | undefined> {
  return openDialog<{ start: boolean }>((close) => (
    <DownloadDialog application={application} running={running} close={close} />
  ));
}

export function askRuntime(
  runtimes: readonly RuntimeState[],
  missing: string | null,
): Promise<RuntimeState | undefined> {
  return openDialog<RuntimeState>((close) => <RuntimeDialog runtimes={runtimes} missing={missing} close={close} />);
}

type Close<Answer> = (answer?: Answer) => void;

/** The application in the runtime is not the one of the project: what now? One choice per relation, as CODESYS asks. */
function LoginDialog({ answer, application, runtime, mayLoad, close }: LoginQuestion & { close: Close<LoginChoice> }) {
  useText();
  const choices: LoginChoice['how'][] = !mayLoad
    ? ['without']
    : answer.relation === 'online_change'
      ? ['online_change', 'download', 'without']
      : answer.relation === 'download'
        ? ['download', 'without']
        : ['download'];
  const [how, setHow] = useState(choices[0]!);
  const [start, setStart] = useState(runtime.state === 'run');
  const values = { application, runtime: runtime.name, other: runtime.application ?? '' };
  return (
    <FormDialog
      title={t('login.title')}
      description={t(`login.relation.${answer.relation}`, values)}
      width={520}
      onClose={() => close()}
      onSubmit={() => close({ how, start: how === 'download' && start })}
      action={t(`login.do.${how}`)}
      focusAction
    >
      {choices.length > 1 && (
        <RadioCards
          label={t('login.how')}
          value={how}
          cards={choices.map((value) => ({
            value,
            name: t(`login.how.${value}`),
            effect: t(`login.effect.${value}`),
          }))}
          onValue={setHow}
        />
      )}
      {answer.relation !== 'empty' && answer.reasons.length > 0 && <Reasons reasons={answer.reasons} />}
      {how === 'download' && (
        <>
          {runtime.state === 'run' && <p className={styles.warning}>{t('login.stops')}</p>}
          <Checkbox checked={start} onChecked={setStart}>
            {t('login.startAfter')}
          </Checkbox>
        </>
      )}
    </FormDialog>
  );
}

function Reasons({ reasons }: { reasons: readonly string[] }) {
  return (
    <details className={styles.reasons}>
      <summary>{t('login.differences', { count: reasons.length })}</summary>
      <ul>
        {reasons.map((reason) => (
          <li key={reason}>{reason}</li>
        ))}
      </ul>
    </details>
  );
}

function DownloadDialog({
  application,
  running,
  close,
}: {
  application: string;
  running: boolean;
  close: Close<{ start: boolean }>;
}) {
  const [start, setStart] = useState(running);
  return (
    <FormDialog
      title={t('download.title')}
      description={t('download.text', { name: application })}
      onClose={() => close()}
      onSubmit={() => close({ start })}
      action={t('login.do.download')}
      focusAction
    >
      {running && <p className={styles.warning}>{t('login.stops')}</p>}
      <Checkbox checked={start} onChecked={setStart}>
        {t('login.startAfter')}
      </Checkbox>
    </FormDialog>
  );
}
