/** What the question before a download says and asks, whichever version it brings. */
import type { LoginAnswer } from '@/api/types';
import { t, useText } from '@/i18n';
import { Checkbox } from '@/ui/Field';
import styles from './dialogs.module.css';

export interface DownloadCosts {
  /** The controller runs: a download stops it. */
  running: boolean;
  /** Persistent variables that cannot keep their values. */
  persistent: LoginAnswer['persistent'];
}

export interface DownloadChoice {
  /** After a download: start at once. */
  start: boolean;
  /** Persistent variables begin with their initial values, all of them. */
  fresh: boolean;
}

interface DownloadTermsProps extends DownloadCosts {
  choice: DownloadChoice;
  onChoice: (choice: DownloadChoice) => void;
}

/** What a download does to the machine, and what is to be done with it afterwards. */
export function DownloadTerms({ running, persistent, choice, onChoice }: DownloadTermsProps) {
  useText();
  return (
    <>
      {running && <p className={styles.warning}>{t('login.stops')}</p>}
      {persistent.length > 0 && (
        <Persistent changes={persistent} fresh={choice.fresh} onFresh={(fresh) => onChoice({ ...choice, fresh })} />
      )}
      <Checkbox checked={choice.start} onChecked={(start) => onChoice({ ...choice, start })}>
        {t('login.startAfter')}
      </Checkbox>
    </>
  );
}

/** The persistent variables that the download cannot keep, and what is to become of the others (PERS-05). */
function Persistent({
  changes,
  fresh,
  onFresh,
}: {
  changes: LoginAnswer['persistent'];
  fresh: boolean;
  onFresh: (fresh: boolean) => void;
}) {
  useText();
  return (
    <div role="group" aria-label={t('login.persistent')}>
      <p className={styles.warning}>{t('login.persistentLost', { count: changes.length })}</p>
      <ul className={styles.persistent}>
        {changes.map(({ path, reason }) => (
          <li key={path}>
            <span className="code">{path}</span> · {t(`login.persistent.${reason}`)}
          </li>
        ))}
      </ul>
      <Checkbox checked={fresh} onChecked={onFresh}>
        {t('login.persistentFresh')}
      </Checkbox>
    </div>
  );
}
