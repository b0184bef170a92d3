import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { DownloadProblem, Recording, TraceState } from './data/source';
import type { Node, TraceData } from './configuration';
import styles from './Trace.module.css';

interface StateBarProps {
  session: OnlineSession | null;
  state: TraceState | null | undefined;
  /** The configuration differs from what was downloaded (TRC-70). */
  changed: boolean;
  download: () => void;
  /** Why it cannot be downloaded. */
  forbidden: string | null;
}

/** What the trace does in the controller: each record with its trigger (TRC-82), or that it has to be downloaded. */
export function StateBar({ session, state, changed, download, forbidden }: StateBarProps) {
  const t = useText();
  if (session === null || state === undefined) return null;
  const button = (
    <Button variant="primary" disabledReason={forbidden} onClick={download}>
      {t('trace.download')}
    </Button>
  );
  if (state === null) {
    return (
      <div className={styles.bar}>
        <span>{t('trace.notDownloaded')}</span>
        {button}
      </div>
    );
  }
  return (
    <>
      {changed && (
        <div className={styles.bar} data-tone="warn">
          <span>{t('trace.changed')}</span>
          {button}
        </div>
      )}
      <div className={styles.bar} role="status" aria-label={t('trace.state')}>
        {state.records.map((record) => (
          <span key={record.name} className={styles.state} data-state={record.state}>
            <i aria-hidden />
            <b>{record.name}</b>
            {t(`trace.state.${record.state}`)}
            {record.trigger && record.state === 'triggered' && (
              <>
                <span className={styles.progress} aria-hidden>
                  <i style={{ width: `${record.trigger.percent}%` }} />
                </span>
                {t('trace.afterTrigger', { percent: Math.round(record.trigger.percent) })}
              </>
            )}
            <span className={styles.muted}>
              {t('trace.filled', { samples: Math.min(record.samples, record.capacity), capacity: record.capacity })}
            </span>
            {record.lost > 0 && <span>{t('trace.lost', { count: record.lost })}</span>}
          </span>
        ))}
        {state.recording && (
          <span className={styles.muted}>{t('trace.recordingNow', { title: state.recording.title })}</span>
        )}
      </div>
    </>
  );
}

/** That a stored recording is shown, and the way back. */
export function StoredBar({
  recording,
  onBack,
  online,
}: {
  recording: Recording;
  onBack: () => void;
  online: boolean;
}) {
  const t = useText();
  return (
    <div className={styles.bar}>
      <span>{t('trace.showsStored', { title: recording.title })}</span>
      <span className={styles.muted}>
        {new Date(recording.started_at).toLocaleString()}
        {recording.state === 'interrupted' && ` · ${t('trace.interrupted')}`}
      </span>
      <span className={styles.grow} />
      <Button onClick={onBack}>{t(online ? 'trace.backToLive' : 'trace.backToConfiguration')}</Button>
    </div>
  );
}

/** What hinders a download, each with the way to its place. */
export function Problems({
  problems,
  data,
  onOpen,
}: {
  problems: readonly DownloadProblem[];
  data: TraceData;
  onOpen: (node: Node) => void;
}) {
  return problems.map((problem, number) => (
    <div key={number} className={styles.bar} data-tone="error" role="alert">
      <b>{data.records[problem.record]?.name}</b>
      <Button variant="quiet" onClick={() => onOpen({ record: problem.record, channel: problem.channel })}>
        {problem.message}
      </Button>
    </div>
  ));
}
