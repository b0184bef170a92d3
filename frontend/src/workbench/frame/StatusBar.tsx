import {
  CircleX,
  CloudOff,
  CloudUpload,
  Equal,
  Hourglass,
  LockKeyhole,
  OctagonAlert,
  TriangleAlert,
  Unplug,
  Workflow,
  X,
  Zap,
} from 'lucide-react';
import { useMemo } from 'react';
import type { LoginRelation } from '@/api/types';
import { useSession } from '@/session/session';
import { listed, useText } from '@/i18n';
import { timeText } from '../clock';
import { showPanel } from '../docking/dock';
import { usePresence } from '../events';
import { countOf, presentMessages, useMessages } from '../messages/store';
import { useFlow } from '../debugger/flow';
import { exceptionPlace, exceptionText, exceptionTitle, jumpToFrame } from '../online/exception';
import { microsText } from '../online/times';
import { useKnownRelation } from '../online/knownRelation';
import { useRuntimeState, useTasks } from '../online/poll';
import { runtimeText } from '../online/runtimeText';
import { useOnline, type OnlineSession } from '../onlineSession';
import { useProject } from '@/project/openProject';
import { useRegistry } from '../commands';
import { runCommand } from '../run';
import { useCommandContext } from '../useCommandContext';
import { useSelection } from '../selection';
import { isSimulated, toneOfApplication } from '../tones';
import { Spinner } from '@/ui/Empty';
import { ToneDot } from '../online/ToneDot';
import { Tooltip } from '@/ui/Tooltip';
import styles from './StatusBar.module.css';

/** Runtime, task, relation of the program, messages, what is under way; at the right cursor, user, connection. */
export function StatusBar() {
  const applicationId = useProject((state) => state.applicationId);
  const session = useOnline((state) => (applicationId ? state.sessions[applicationId] : undefined));
  useRuntimeState(session?.runtimeId ?? null);
  return (
    <footer className={styles.bar} role="status">
      {session ? (
        <>
          <RuntimeItem session={session} />
          <TaskItem runtimeId={session.runtimeId} />
          <PaceItem pacedMs={session.pacedMs} />
          <RelationItem relation={session.relation} />
          <ForceItem runtimeId={session.runtimeId} />
          <FlowItem runtimeId={session.runtimeId} />
          <ExceptionItem session={session} />
        </>
      ) : (
        <OfflineItem />
      )}
      <MessageItem />
      <BusyItem />
      <span className={styles.spacer} />
      <CursorItem />
      <UserItem />
      <ConnectionItem />
    </footer>
  );
}

function RuntimeItem({ session }: { session: OnlineSession }) {
  const t = useText();
  const sessions = useOnline((state) => state.sessions);
  const tone = toneOfApplication(session.applicationId, sessions) ?? 'unknown';
  const { runtime, lostSince } = session;
  const detail = [runtime?.exception?.message, runtime?.scheduling].filter(Boolean).join('\n') || undefined;
  const state =
    lostSince !== null
      ? t('online.lostSince', { time: timeText(lostSince) })
      : runtime
        ? runtimeText(runtime, t)
        : t('state.loading');
  return (
    <Tooltip text={`${runtime?.name ?? ''} · ${state}`} detail={detail} side="top">
      <button
        type="button"
        className={`${styles.item} ${styles.runtime}`}
        data-tone={tone}
        onClick={() => showPanel(runtime?.exception ? 'callStack' : 'log')}
      >
        <ToneDot tone={tone} size={8} />
        {runtime?.name}
        <span>{state}</span>
        {isSimulated(session.applicationId) && <span>({t('online.tone.simulated')})</span>}
      </button>
    </Tooltip>
  );
}

/** The task that the engineer cares most about: the one with the highest priority. */
function TaskItem({ runtimeId }: { runtimeId: string }) {
  const t = useText();
  const { data } = useTasks(runtimeId);
  const task = useMemo(() => [...(data ?? [])].sort((a, b) => (a.priority ?? 99) - (b.priority ?? 99))[0], [data]);
  if (!task) return null;
  return (
    <Tooltip
      text={t('status.taskTitle', { name: task.name })}
      detail={t('status.taskDetail', {
        mean: microsText(task.average_us),
        max: microsText(task.max_us),
        jitter: microsText(task.max_jitter_us),
      })}
      side="top"
    >
      <button type="button" className={styles.item} onClick={() => showPanel('tasks')}>
        {task.name}
        <span className={styles.measure}>{microsText(task.last_us)}</span>
        <span className={styles.measure}>±{microsText(Math.abs(task.jitter_us))}</span>
      </button>
    </Tooltip>
  );
}

const RELATIONS: Record<LoginRelation, { icon: typeof Zap; className: string | undefined }> = {
  same: { icon: Equal, className: styles.ok },
  online_change: { icon: Zap, className: styles.warn },
  download: { icon: CloudUpload, className: styles.warn },
  foreign: { icon: CloudUpload, className: styles.error },
  empty: { icon: CloudUpload, className: styles.error },
};

function RelationItem({ relation }: { relation: LoginRelation }) {
  const t = useText();
  const { icon: Icon, className } = RELATIONS[relation];
  return (
    <Tooltip text={t(`relation.${relation}`)} detail={t('changes.show')} side="top">
      <button type="button" className={`${styles.item} ${className}`} onClick={() => showPanel('onlineChanges')}>
        <Icon size={14} aria-label={t(`relation.${relation}`)} />
      </button>
    </Tooltip>
  );
}

/** Values come less often than asked for: who watches much gets them so, others do not. */
function PaceItem({ pacedMs }: { pacedMs: number | null }) {
  const t = useText();
  if (pacedMs === null) return null;
  const text = t('status.paced', { interval: microsText(pacedMs * 1000) });
  return (
    <Tooltip text={text} detail={t('status.pacedText')} side="top">
      <span className={`${styles.item} ${styles.warn}`} tabIndex={0}>
        <Hourglass size={13} aria-hidden />
        {text}
      </span>
    </Tooltip>
  );
}

/** That something is forced must not be forgotten, whatever panels are closed. */
function ForceItem({ runtimeId }: { runtimeId: string }) {
  const t = useText();
  const count = useOnline((state) => state.forces[runtimeId]?.length ?? 0);
  if (count === 0) return null;
  return (
    <Tooltip text={t('status.forced', { count })} side="top">
      <button
        type="button"
        className={`${styles.item} ${styles.force}`}
        aria-label={t('status.forced', { count })}
        onClick={() => showPanel('forces')}
      >
        <LockKeyhole size={13} aria-hidden />
        {t('status.force')} <span className="digits">{count}</span>
      </button>
    </Tooltip>
  );
}

/** Flow control makes programs slower: it must not be forgotten, either. */
function FlowItem({ runtimeId }: { runtimeId: string }) {
  const t = useText();
  const on = useFlow(({ runtimes }) => runtimeId in runtimes);
  if (!on) return null;
  return (
    <Tooltip text={t('debugger.flowOn')} detail={t('debugger.flowOff')} side="top">
      <button
        type="button"
        className={`${styles.item} ${styles.ok}`}
        onClick={() => void runCommand('debug.flowControl')}
      >
        <Workflow size={13} aria-hidden />
        {t('debugger.flowControl')}
      </button>
    </Tooltip>
  );
}

/** What stopped the application, as long as it lasts; a click leads to its place. */
function ExceptionItem({ session }: { session: OnlineSession }) {
  const exception = session.runtime?.exception;
  if (!exception) return null;
  const title = exceptionTitle(exception);
  const place = exceptionPlace(exception);
  const text = [title, place].filter(Boolean).join(' · ');
  return (
    <Tooltip text={text} detail={exceptionText(exception) || undefined} side="top">
      <button type="button" className={`${styles.item} ${styles.exception}`} onClick={() => jumpToFrame(exception)}>
        <OctagonAlert size={13} aria-hidden />
        <span>{text}</span>
      </button>
    </Tooltip>
  );
}

function OfflineItem() {
  const t = useText();
  const applicationId = useProject((state) => state.applicationId);
  const relation = useKnownRelation((state) =>
    applicationId ? state.known[applicationId]?.answer.relation : undefined,
  );
  if (!applicationId) return null;
  return (
    <>
      <Tooltip text={t('command.login')} shortcut="Alt+F8" side="top">
        <button type="button" className={styles.item} onClick={() => void runCommand('online.login')}>
          <Unplug size={13} aria-hidden />
          {t('status.offline')}
        </button>
      </Tooltip>
      {relation && relation !== 'empty' && <OfflineRelation relation={relation} />}
    </>
  );
}

/** What a login would find, in words: it is what one wants to know before one goes there. */
function OfflineRelation({ relation }: { relation: LoginRelation }) {
  const t = useText();
  const { icon: Icon, className } = RELATIONS[relation];
  return (
    <Tooltip text={t(`relation.${relation}`)} detail={t('changes.show')} side="top">
      <button type="button" className={`${styles.item} ${className}`} onClick={() => showPanel('onlineChanges')}>
        <Icon size={13} aria-hidden />
        {t(`relation.short.${relation}`)}
      </button>
    </Tooltip>
  );
}

function MessageItem() {
  const t = useText();
  const { build, live } = useMessages();
  const count = useMemo(() => countOf(presentMessages(build, live)), [build, live]);
  return (
    <Tooltip text={t('status.messages')} side="top">
      <button type="button" className={styles.item} onClick={() => showPanel('messages')}>
        <CircleX size={13} className={count.error ? styles.error : undefined} aria-hidden />
        <span aria-hidden>{count.error}</span>
        <TriangleAlert size={13} className={count.warning ? styles.warn : undefined} aria-hidden />
        <span aria-hidden>{count.warning}</span>
        <span className="visually-hidden">
          {listed([t('messages.error', { count: count.error }), t('messages.warning', { count: count.warning })])}
        </span>
      </button>
    </Tooltip>
  );
}

function BusyItem() {
  const t = useText();
  const busy = useProject((state) => state.busy);
  if (!busy) return null;
  return (
    <span className={styles.item}>
      <Spinner size={13} />
      {busy.text}
      {busy.cancel && (
        <Tooltip text={t('action.cancel')} side="top">
          <button
            type="button"
            className={styles.item}
            style={{ padding: '0 3px' }}
            aria-label={t('action.cancel')}
            onClick={busy.cancel}
          >
            <X size={13} />
          </button>
        </Tooltip>
      )}
    </span>
  );
}

function CursorItem() {
  const t = useText();
  const cursor = useSelection((state) => (state.activeEditor ? state.cursors.get(state.activeEditor) : undefined));
  const context = useCommandContext();
  const tabMoves = useRegistry((state) => state.commands.get('st.tabMovesFocus')?.checked?.(context) === true);
  if (!cursor) return null;
  const position = t('status.position', { line: cursor.line, column: cursor.column });
  return (
    <>
      <button
        type="button"
        className={styles.item}
        title={t('status.tabRules')}
        onClick={() => void runCommand('st.tabMovesFocus')}
      >
        {t(tabMoves ? 'status.tabMoves' : 'status.tabIndents')}
      </button>
      <span className={styles.item}>
        {cursor.selected
          ? t('text.andMore', { text: position, more: t('status.selected', { count: cursor.selected }) })
          : position}
      </span>
    </>
  );
}

function UserItem() {
  const t = useText();
  const user = useSession((state) => state.user);
  return (
    user && (
      <span className={styles.item}>
        {user.username} · {t(`role.${user.role}`)}
      </span>
    )
  );
}

function ConnectionItem() {
  const t = useText();
  const connected = usePresence((state) => state.connected);
  if (connected) return null;
  return (
    <Tooltip text={t('status.noServer')} detail={t('status.noServerText')} side="top">
      <span className={`${styles.item} ${styles.warn}`}>
        <CloudOff size={14} aria-label={t('status.noServer')} />
      </span>
    </Tooltip>
  );
}
