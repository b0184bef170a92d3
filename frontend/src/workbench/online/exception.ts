/** The exception of an application: shown once when it happens, and the ways to its place. */
import type { PastMoment } from '../onlineSession';
import { keys, queryClient } from '@/api/queries';
import type { CallFrame, ObjectSummary, RuntimeException } from '@/api/types';
import { t, type TextKey } from '@/i18n';
import { openObject, showPanel } from '../docking/dock';
import { notify } from '@/ui/notices';
import { useOnline, type OnlineSession } from '../onlineSession';
import { useProject } from '@/project/openProject';
import { objectPath } from '@/project/tree';
import { waitsForStart } from './runtimeText';

const KINDS: Readonly<Record<string, TextKey>> = {
  DIV_ZERO: 'exception.divisionByZero',
  ARRAY_BOUNDS: 'exception.arrayBounds',
  NULL_REFERENCE: 'exception.nullReference',
  ACCESS_VIOLATION: 'exception.accessViolation',
  STACK_OVERFLOW: 'exception.stackOverflow',
  WATCHDOG: 'exception.watchdog',
  ASSERT: 'exception.assertion',
  ILLEGAL_CONVERSION: 'exception.conversion',
  INVALID_RELEASE: 'exception.invalidRelease',
  HEAP_DAMAGED: 'exception.heapDamaged',
  PROCESS_ENDED: 'exception.processEnded',
};

/** What happened, in the user's language where the kind is known. */
export function exceptionTitle(exception: RuntimeException): string {
  const kind = KINDS[exception.name];
  return kind === undefined ? exception.message : t(kind);
}

/** More about it than the title says: what to do, or what the runtime found; nothing when that is the same. */
export function exceptionText(exception: RuntimeException): string {
  if (waitsForStart(exception)) return t('exception.startAnyway', { signal: exception.values.signal ?? '–' });
  const same = exception.message.toLowerCase() === exceptionTitle(exception).toLowerCase();
  return same ? '' : exception.message;
}

/** `PLC_PRG, line 2, task MainTask` */
export function exceptionPlace(exception: RuntimeException): string {
  const task = exception.task && t('exception.inTask', { task: exception.task });
  return [placeText(exception), task].filter(Boolean).join(', ');
}

function placeText({ pou, line }: Pick<CallFrame, 'pou' | 'line'>): string {
  return [pou, line === null ? '' : t('exception.line', { line })].filter(Boolean).join(', ');
}

/** The exceptions of these sessions that the sessions before did not have. */
export function newExceptions(
  now: Readonly<Record<string, OnlineSession>>,
  before: Readonly<Record<string, OnlineSession>>,
): OnlineSession[] {
  return Object.values(now).filter((session) => {
    const exception = session.runtime?.exception;
    return exception != null && before[session.applicationId]?.runtime?.exception == null;
  });
}

/** The path of the object a frame is in, as everywhere else; of other code only what the runtime says. */
export function framePath(frame: CallFrame): string {
  const path = frame.object_id === null ? '' : objectPath(objectsNow(), frame.object_id);
  return path || (frame.uri ?? frame.pou ?? '');
}

/** Opens the object of a frame at its line; a place in a library or in the system has none. */
export function jumpToFrame(frame: CallFrame, focus = true): void {
  const object = objectsNow().find((candidate) => candidate.id === frame.object_id);
  if (object === undefined) {
    notify({ tone: 'info', title: t('messages.noPlace'), text: framePath(frame) });
    return;
  }
  const place = { part: frame.part ?? undefined, line: frame.line ?? undefined };
  openObject(object.id, object.name, { place, focus });
}

function objectsNow(): readonly ObjectSummary[] {
  const { projectId } = useProject.getState();
  return (projectId && queryClient.getQueryData<ObjectSummary[]>(keys.objects(projectId))) || [];
}

/**
 * Shows where an application stops with an exception. That of the active one stands in the status bar and in the panel:
 * a notice would lie over the values that one looks at now.
 */
export function followExceptions(): () => void {
  return useOnline.subscribe(({ sessions }, before) => {
    for (const { applicationId, runtime } of newExceptions(sessions, before.sessions)) {
      const exception = runtime!.exception!;
      showPanel('callStack', false);
      if (applicationId === useProject.getState().applicationId) continue;
      notify({
        tone: 'error',
        title: t('exception.happened', { what: exceptionTitle(exception) }),
        text: exceptionPlace(exception),
        action: { text: t('exception.goTo'), run: () => jumpToFrame(exception) },
      });
    }
  });
}

/** Whether the application failed in this past cycle: the calls that led there are those of it alone. */
export const isFaultCycle = ({ fault, before }: PastMoment) => fault && before === 0;
