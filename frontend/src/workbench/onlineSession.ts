/**
 * Which application is logged in to which runtime, and in what state that runtime is.
 *
 * The online commands of the workbench write the logins. `src/online` opens the socket for each runtime named here and
 * reports what it hears through `runtimeStateReceived`, `connectionLost` and `forcesReceived`.
 */
import { create } from 'zustand';
import type { ImagePlace, LoginRelation, RuntimeState } from '@/api/types';

/** A past cycle whose values are shown in place of the live ones. */
export interface PastMoment {
  cycle: number;
  /** Its end, milliseconds since 1970. */
  at: number;
  /** Milliseconds from there to the last cycle that is kept. */
  before: number;
  /** Whether that last cycle is the one in which the application failed. */
  fault: boolean;
}

export interface OnlineSession {
  applicationId: string;
  runtimeId: string;
  /** What the runtime holds compared with the project, asked at login and after each build. */
  relation: LoginRelation;
  /** Latest word of the runtime, null before the first. */
  runtime: RuntimeState | null;
  /** Milliseconds since 1970 when the connection broke, null while it stands. */
  lostSince: number | null;
  /** Milliseconds between values where the server gives them less often than asked for; null where it does not. */
  pacedMs: number | null;
  /** Null while values are live. */
  past: PastMoment | null;
}

/** Whether a recording of the flight recorder is looked into in place of a runtime. */
export function isRecording(runtimeId: string | null | undefined): boolean {
  return runtimeId?.startsWith('recording-') === true;
}

interface OnlineState {
  sessions: Readonly<Record<string, OnlineSession>>;
  /** Paths of forced variables, by runtime. */
  forces: Readonly<Record<string, readonly string[]>>;
  /** Where they lie, by runtime: a variable is forced under each of its names. */
  forcedPlaces: Readonly<Record<string, readonly ImagePlace[]>>;
}

export const useOnline = create<OnlineState>(() => ({ sessions: {}, forces: {}, forcedPlaces: {} }));

export function loggedIn(applicationId: string, runtimeId: string, relation: LoginRelation): void {
  const session: OnlineSession = {
    applicationId,
    runtimeId,
    relation,
    runtime: null,
    lostSince: null,
    pacedMs: null,
    past: null,
  };
  useOnline.setState((state) => ({ sessions: { ...state.sessions, [applicationId]: session } }));
}

export function loggedOut(applicationId: string): void {
  useOnline.setState((state) => {
    const { [applicationId]: _gone, ...sessions } = state.sessions;
    return { sessions };
  });
}

export function relationChanged(applicationId: string, relation: LoginRelation): void {
  change((session) => session.applicationId === applicationId, { relation });
}

/**
 * The online socket heard a runtime's state. The way to the server stands, then; whether the server still reaches the
 * runtime is in the state itself.
 */
export function runtimeStateReceived(runtimeId: string, runtime: RuntimeState): void {
  if (!runtime.connected) {
    connectionLost(runtimeId, runtime.since === null ? undefined : Date.parse(runtime.since));
    runtimePolled(runtimeId, runtime);
  } else change((session) => session.runtimeId === runtimeId, { runtime, lostSince: null });
}

/** A state read by REST: it says nothing about the online channel, so a lost connection stays lost. */
export function runtimePolled(runtimeId: string, runtime: RuntimeState): void {
  change((session) => session.runtimeId === runtimeId, { runtime });
}

/** The online socket lost a runtime; values are frozen from now on. */
export function connectionLost(runtimeId: string, since: number = Date.now()): void {
  change((session) => session.runtimeId === runtimeId && session.lostSince === null, { lostSince: since });
}

export function valuesPaced(runtimeId: string, pacedMs: number | null): void {
  const differs = (session: OnlineSession) => session.runtimeId === runtimeId && session.pacedMs !== pacedMs;
  if (Object.values(useOnline.getState().sessions).some(differs)) change(differs, { pacedMs });
}

/** Views show the values of a past cycle from now on, or live ones with null. */
export function pastShown(runtimeId: string, past: PastMoment | null): void {
  const differs = (session: OnlineSession) => session.runtimeId === runtimeId && session.past !== past;
  if (Object.values(useOnline.getState().sessions).some(differs)) change(differs, { past });
}

export function forcesReceived(runtimeId: string, paths: readonly string[], places: readonly ImagePlace[]): void {
  useOnline.setState((state) => ({
    forces: { ...state.forces, [runtimeId]: paths },
    forcedPlaces: { ...state.forcedPlaces, [runtimeId]: places },
  }));
}

function change(where: (session: OnlineSession) => boolean, values: Partial<OnlineSession>): void {
  useOnline.setState((state) => {
    const sessions = { ...state.sessions };
    for (const [id, session] of Object.entries(sessions)) if (where(session)) sessions[id] = { ...session, ...values };
    return { sessions };
  });
}

/** How a session looks: the colour of editor headers, tree nodes and the status bar. */
export type OnlineTone = 'running' | 'halted' | 'stopped' | 'exception' | 'simulated' | 'lost' | 'past' | 'unknown';

export function onlineTone(session: OnlineSession | null | undefined, simulated = false): OnlineTone {
  if (!session?.runtime) return session?.lostSince ? 'lost' : 'unknown';
  if (session.lostSince !== null || !session.runtime.connected) return 'lost';
  if (session.past !== null) return 'past';
  if (session.runtime.halted.length > 0) return 'halted';
  switch (session.runtime.state) {
    case 'run':
      return simulated ? 'simulated' : 'running';
    case 'exception':
      return 'exception';
    default:
      return 'stopped';
  }
}
