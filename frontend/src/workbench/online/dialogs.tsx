/** The questions before something happens to a machine. */
import { useState } from 'react';
import type { LoginAnswer, RuntimeState } from '@/api/types';
import { t, useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { FormDialog } from '@/ui/FormDialog';
import { RadioCards } from '@/ui/RadioCards';
import { ChangesTable } from './ChangesTable';
import styles from './dialogs.module.css';
import { DownloadTerms, type DownloadChoice, type DownloadCosts } from './DownloadTerms';
import { loginChoices, proposedChoice, type LoginHow } from './loginChoices';
import { RuntimeDialog } from './RuntimeDialog';

export interface LoginChoice extends DownloadChoice {
  how: LoginHow;
}

interface LoginQuestion {
  answer: LoginAnswer;
  application: string;
  project: string;
  runtime: RuntimeState;
  /** Whether this user may download; others only look. */
  mayLoad: boolean;
}

export function askLogin(question: LoginQuestion): Promise<LoginChoice | undefined> {
  return openDialog<LoginChoice>((close) => <LoginDialog {...question} close={close} />);
}

interface DownloadQuestion extends DownloadCosts {
  application: string;
  project: string;
}

export function askDownload(question: DownloadQuestion): Promise<DownloadChoice | undefined> {
  return openDialog<DownloadChoice>((close) => <DownloadDialog {...question} close={close} />);
}

/** The application has errors, and the runtime holds an older state of it: look at that one? */
export function askLoginWithErrors(application: string, project: string, runtime: string): Promise<true | undefined> {
  return openDialog<true>((close) => (
    <FormDialog
      title={t('login.buildErrors')}
      description={t('login.withErrors', { application, project, runtime })}
      onClose={() => close()}
      onSubmit={() => close(true)}
      action={t('login.do.unloaded')}
      focusAction
    />
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
function LoginDialog({
  answer,
  application,
  project,
  runtime,
  mayLoad,
  close,
}: LoginQuestion & { close: Close<LoginChoice> }) {
  useText();
  const running = runtime.state === 'run';
  const choices = loginChoices(answer.relation, mayLoad);
  const proposed = proposedChoice(choices, running);
  const [how, setHow] = useState(proposed ?? choices[0]!);
  const [choice, setChoice] = useState<DownloadChoice>({ start: running, fresh: false });
  const otherProject = answer.loaded_project ?? '';
  const values = { application, project, runtime: runtime.name, other: runtime.application ?? '', otherProject };
  const relation = answer.relation === 'foreign' && otherProject !== '' ? 'foreignProject' : answer.relation;
  return (
    <FormDialog
      title={t('login.title')}
      description={t(`login.relation.${relation}`, values)}
      width={answer.changes.length > 0 ? 860 : 520}
      onClose={() => close()}
      onSubmit={() => close({ how, ...(how === 'download' ? choice : { start: false, fresh: false }) })}
      action={t(`login.do.${how}`)}
      focusAction={proposed !== null}
      focusCancel={proposed === null}
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
      {answer.changes.length > 0 ? (
        <div className={styles.changes}>
          <ChangesTable answer={answer} onLeave={() => close()} />
        </div>
      ) : (
        answer.relation !== 'empty' && answer.reasons.length > 0 && <Reasons reasons={answer.reasons} />
      )}
      {how === 'download' && (
        <DownloadTerms running={running} persistent={answer.persistent} choice={choice} onChoice={setChoice} />
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
  project,
  running,
  persistent,
  close,
}: DownloadQuestion & { close: Close<DownloadChoice> }) {
  useText();
  const [choice, setChoice] = useState<DownloadChoice>({ start: running, fresh: false });
  return (
    <FormDialog
      title={t('download.title')}
      description={t('download.text', { name: application, project })}
      onClose={() => close()}
      onSubmit={() => close(choice)}
      action={t('login.do.download')}
      focusAction={!running}
      focusCancel={running}
    >
      <DownloadTerms running={running} persistent={persistent} choice={choice} onChoice={setChoice} />
    </FormDialog>
  );
}
