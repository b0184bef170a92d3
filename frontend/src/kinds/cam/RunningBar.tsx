import { Download, PencilLine, Upload } from 'lucide-react';
import { useText } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import { LostBar } from '@/online/LostBar';
import { useFlag, useLiveNumber } from '@/online/useLive';
import { Button } from '@/ui/Button';
import { explain } from '@/ui/notices';
import type { OnlineSession } from '@/workbench/onlineSession';
import { runCommand } from '@/workbench/run';
import type { CamTable } from './camTable';
import styles from './Cam.module.css';
import { followed, useRunningCam } from './runningCam';

const MOST_SHOWN = 3;

interface RunningBarProps {
  session: OnlineSession;
  name: string;
  /** That of the project, without what is being dragged. */
  cam: CamTable;
  followers: readonly string[];
  /** The cam may be changed while the application runs. */
  editing: boolean;
  onEdit: () => void;
  /** Why it may not be changed at all. */
  forbidden: string | null;
}

/** While logged in: who follows the cam and where, and whether the application has the cam that is shown. */
export function RunningBar({ session, name, cam, followers, editing, onEdit, forbidden }: RunningBarProps) {
  const t = useText();
  const running = useRunningCam(session, name, cam);
  const state = running.error
    ? (explain(running.error).text ?? explain(running.error).title)
    : running.data && t(running.data.same ? 'cam.runningSame' : 'cam.runningOther');
  return (
    <>
      <LostBar session={session} />
      <div className={styles.running} role="group" aria-label={t('cam.running')}>
        <ul className={styles.followers}>
          {followers.slice(0, MOST_SHOWN).map((path) => (
            <Follower key={path} runtimeId={session.runtimeId} path={path} />
          ))}
          {followers.length > MOST_SHOWN && <li>{t('cam.moreFollowers', { count: followers.length - MOST_SHOWN })}</li>}
          {followers.length === 0 && <li>{t('cam.noFollowers')}</li>}
        </ul>
        <span className={styles.runningState} data-other={running.data?.same === false || undefined} role="status">
          {state}
        </span>
        <Button icon={PencilLine} disabledReason={forbidden} aria-pressed={editing} onClick={onEdit}>
          {t('cam.editOnline')}
        </Button>
        <Button
          icon={Upload}
          disabledReason={editing ? null : t('cam.editFirst')}
          onClick={() => void runCommand('cam.readRunning')}
        >
          {t('cam.read')}
        </Button>
        <Button
          icon={Download}
          disabledReason={running.data?.same === true ? t('cam.nothingToWrite') : null}
          onClick={() => void runCommand('cam.writeRunning')}
        >
          {t('cam.write')}
        </Button>
      </div>
    </>
  );
}

function Follower({ runtimeId, path }: { runtimeId: string; path: string }) {
  const t = useText();
  const x = useLiveNumber(runtimeId, followed.master(path));
  const y = useLiveNumber(runtimeId, followed.slave(path));
  const inSync = useFlag(runtimeId, followed.inSync(path));
  return (
    <li>
      <i className={styles.runSign} aria-hidden />
      <b className="code">{path}</b>
      <span className={`digits ${styles.place}`}>{`X ${shown(x)}`}</span>
      <span className={`digits ${styles.place}`}>{`Y ${shown(y)}`}</span>
      {!inSync && t('cam.comingIn')}
    </li>
  );
}

/** With few digits: it changes ten times a second. */
const shown = (value: number | null) => (value === null ? '–' : numberText(Number(value.toPrecision(5))));
