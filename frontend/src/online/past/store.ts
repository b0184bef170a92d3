/** Looking back: the time bar of each runtime, and the way of its channel through past cycles. */
import { create } from 'zustand';
import { api } from '@/api/client';
import { guard, notify } from '@/ui/notices';
import { t } from '@/i18n';
import { pastShown, useOnline, type OnlineSession } from '@/workbench/onlineSession';
import { channelOf, onLooked } from '../connections';
import { indexAt, momentOf, pastMoment, stepped, type Moment } from './timeline';

/** The time bar of one runtime. */
export interface TimeBarState {
  readonly moments: readonly Moment[];
  /** Where the slider stands; null: at the present. */
  readonly at: number | null;
  /** Whether the last moment is the end of the cycle in which the application failed. */
  readonly fault: boolean;
  /** More than 1: a value may be so many entries old, less one. */
  readonly parts: number;
  /** Whether nothing is recorded because somebody looks back. */
  readonly frozen: boolean;
  /** Factor of the time while it plays; null while it stands. */
  readonly playing: number | null;
}

export const useTimeBars = create<{ bars: Readonly<Record<string, TimeBarState>> }>(() => ({ bars: {} }));

/** Factors of time: as it was, and slower. */
export const SPEEDS = [1, 0.5, 0.1, 0.01] as const;

export function timeBar(runtimeId: string | null | undefined): TimeBarState | null {
  return runtimeId == null ? null : (useTimeBars.getState().bars[runtimeId] ?? null);
}

function change(runtimeId: string, values: Partial<TimeBarState>): void {
  const bar = timeBar(runtimeId);
  if (bar === null) return;
  useTimeBars.setState(({ bars }) => ({ bars: { ...bars, [runtimeId]: { ...bar, ...values } } }));
}

const of = (runtimeId: string) => ({ params: { path: { runtime_id: runtimeId } } });

/** This page, among all that may look back at the same runtime. */
const OWNER = `page-${Array.from(crypto.getRandomValues(new Uint32Array(2)), (part) => part.toString(36)).join('')}`;
/** A page that is gone lets recording go on after this time. Browsers slow the timers of hidden pages to one a minute. */
const LEASE_S = 180;
const RENEW_MS = 30_000;

function freeze(runtimeId: string, on: boolean) {
  const body = { on, owner: OWNER, lease_s: on ? LEASE_S : null };
  return api.post('/api/v1/runtimes/{runtime_id}/flight/freeze', { ...of(runtimeId), body });
}

/** Keeps what is frozen for this page, as long as it is there. */
export function renewFreezes(): void {
  for (const [runtimeId, bar] of Object.entries(useTimeBars.getState().bars))
    if (bar.frozen)
      void api
        .post('/api/v1/runtimes/{runtime_id}/flight/renew', {
          ...of(runtimeId),
          body: { owner: OWNER, lease_s: LEASE_S },
        })
        .catch(() => undefined); // the bar says what is not kept when one gets there
}

/**
 * Opens the time bar of a runtime. Where the application runs, recording stops first, so that nothing is dropped while
 * one looks, and the last cycle is shown.
 */
export async function openTimeBar({ runtimeId, runtime }: OnlineSession): Promise<void> {
  const running = runtime?.state === 'run';
  let state = await api.get('/api/v1/runtimes/{runtime_id}/flight', of(runtimeId));
  if (running) state = await freeze(runtimeId, true);
  const rows = await api.get('/api/v1/runtimes/{runtime_id}/flight/cycles', of(runtimeId));
  if (rows.length === 0) {
    if (running) await freeze(runtimeId, false);
    notify({ tone: 'info', title: t('past.nothing'), text: t('past.nothingText') });
    return;
  }
  const bar: TimeBarState = {
    moments: rows.map(momentOf),
    at: null,
    fault: runtime?.exception != null,
    parts: state.parts,
    frozen: state.frozen_by === 'request',
    playing: null,
  };
  useTimeBars.setState(({ bars }) => ({ bars: { ...bars, [runtimeId]: bar } }));
  if (running) lookAt(runtimeId, bar.moments.length - 1);
}

/** Back to live values; recording goes on. */
export async function closeTimeBar(runtimeId: string): Promise<void> {
  const bar = timeBar(runtimeId);
  forget(runtimeId);
  if (bar?.frozen) await freeze(runtimeId, false);
}

function forget(runtimeId: string): void {
  stopPlaying(runtimeId);
  useTimeBars.setState(({ bars }) => {
    const { [runtimeId]: _closed, ...rest } = bars;
    return { bars: rest };
  });
  wanted.delete(runtimeId);
  asked.delete(runtimeId);
  channelOf(runtimeId)?.lookBack(null);
  pastShown(runtimeId, null);
}

/** Cycles asked for and not answered yet, and what is wanted after them: one question is under way at a time. */
const asked = new Map<string, number | null>();
const wanted = new Map<string, number | null>();

/** Moves the slider to an index, null: to the present; all views follow. */
export function lookAt(runtimeId: string, index: number | null): void {
  const bar = timeBar(runtimeId);
  if (bar === null) return;
  change(runtimeId, { at: index });
  const cycle = index === null ? null : (bar.moments[index]?.cycle ?? null);
  if (asked.has(runtimeId)) wanted.set(runtimeId, cycle);
  else ask(runtimeId, cycle);
}

function ask(runtimeId: string, cycle: number | null): void {
  const channel = channelOf(runtimeId);
  if (channel === null) return;
  asked.set(runtimeId, cycle);
  channel.lookBack(cycle);
}

/** The server shows a cycle from now on, or says why it cannot. */
export function looked(runtimeId: string, cycle: number | null, problem: string | null): void {
  asked.delete(runtimeId);
  const bar = timeBar(runtimeId);
  const index = bar === null || cycle === null ? -1 : bar.moments.findIndex((moment) => moment.cycle === cycle);
  pastShown(runtimeId, bar === null ? null : pastMoment(bar.moments, index, bar.fault));
  const next = wanted.get(runtimeId);
  wanted.delete(runtimeId);
  if (problem !== null) {
    stopPlaying(runtimeId);
    change(runtimeId, { at: index < 0 ? null : index });
    notify({ tone: 'error', title: t('past.notShown'), text: problem });
  } else if (next !== undefined && next !== cycle) ask(runtimeId, next);
  else if (next === undefined && cycle === null && bar !== null && bar.at !== null) change(runtimeId, { at: null });
}

/** The connection is gone: values are shown live again once it is back. */
export function lostPast(runtimeId: string): void {
  asked.delete(runtimeId);
  wanted.delete(runtimeId);
  stopPlaying(runtimeId);
  change(runtimeId, { at: null });
  pastShown(runtimeId, null);
}

/** Back or, with 1, forward by a cycle; behind the last one are live values. */
export async function step(runtimeId: string, delta: number): Promise<void> {
  stopPlaying(runtimeId);
  const bar = timeBar(runtimeId);
  if (bar === null) return;
  if (delta > 0 && (bar.at === null || bar.at >= bar.moments.length - 1)) return toPresent(runtimeId);
  // Standing still, the present is the end of the last cycle: the first step back leads to the one before.
  const standing = bar.at === null && !bar.frozen && delta < 0 && bar.moments.length > 1 ? -1 : 0;
  lookAt(runtimeId, stepped(bar.moments.length, bar.at, delta + standing));
}

/** To where nothing is shown of the past; where the application stands, the bar stays for another look back. */
async function toPresent(runtimeId: string): Promise<void> {
  if (timeBar(runtimeId)?.frozen === true) await closeTimeBar(runtimeId);
  else lookAt(runtimeId, null);
}

// -- playing ---------------------------------------------------------------------------------------------

const FRAME_MS = 50;
const players = new Map<string, ReturnType<typeof setInterval>>();

function stopPlaying(runtimeId: string): void {
  const player = players.get(runtimeId);
  if (player === undefined) return;
  clearInterval(player);
  players.delete(runtimeId);
  change(runtimeId, { playing: null });
}

/** Runs through the cycles from where the slider stands, from the start where it stands at the end; or stops. */
export function togglePlay(runtimeId: string, speed = 1): void {
  const bar = timeBar(runtimeId);
  if (bar === null) return;
  if (bar.playing !== null) {
    stopPlaying(runtimeId);
    return;
  }
  const last = bar.moments.length - 1;
  play(runtimeId, bar.at === null || bar.at >= last ? 0 : bar.at, speed);
}

function play(runtimeId: string, from: number, speed: number, ended: () => void = () => undefined): void {
  const began = performance.now();
  change(runtimeId, { playing: speed });
  lookAt(runtimeId, from);
  const player = setInterval(() => {
    const { moments } = timeBar(runtimeId) ?? { moments: [] };
    const start = moments[from];
    if (start === undefined) return stopPlaying(runtimeId);
    const index = indexAt(moments, start.at + (performance.now() - began) * speed);
    if (index !== timeBar(runtimeId)?.at) lookAt(runtimeId, index);
    if (index < moments.length - 1) return;
    stopPlaying(runtimeId);
    ended();
  }, FRAME_MS);
  players.set(runtimeId, player);
}

/** Runs through the cycles from where the slider stands, and on into the present. */
export function playToPresent(runtimeId: string): void {
  stopPlaying(runtimeId);
  const bar = timeBar(runtimeId);
  if (bar === null) return;
  if (bar.at === null || bar.at >= bar.moments.length - 1) void guard(() => toPresent(runtimeId));
  else play(runtimeId, bar.at, 1, () => void guard(() => toPresent(runtimeId)));
}

/** Plays at another speed from where it is. */
export function setSpeed(runtimeId: string, speed: number): void {
  stopPlaying(runtimeId);
  togglePlay(runtimeId, speed);
}

// -- following -------------------------------------------------------------------------------------------

/** What is kept begins anew when the programs run again; a bar of a session that has ended goes away. */
export function followTimeBars(): () => void {
  onLooked(looked);
  const renewing = setInterval(renewFreezes, RENEW_MS);
  const unsubscribe = useOnline.subscribe(({ sessions }, before) => {
    for (const runtimeId of Object.keys(useTimeBars.getState().bars)) {
      const now = Object.values(sessions).find((session) => session.runtimeId === runtimeId);
      const then = Object.values(before.sessions).find((session) => session.runtimeId === runtimeId);
      const ended = now === undefined;
      const started = now?.runtime?.state === 'run' && then?.runtime != null && then.runtime.state !== 'run';
      const replaced = now?.runtime != null && then?.runtime != null && now.runtime.data_id !== then.runtime.data_id;
      if (ended && timeBar(runtimeId)?.frozen) void freeze(runtimeId, false).catch(() => undefined);
      if (ended || started || replaced) forget(runtimeId);
      else if (now?.lostSince != null && then?.lostSince === null) lostPast(runtimeId);
    }
  });
  return () => {
    clearInterval(renewing);
    unsubscribe();
  };
}
