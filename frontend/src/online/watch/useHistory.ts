import { useEffect, useMemo, useRef } from 'react';
import { channelOf } from '../connections';
import { useWatched } from '../useLive';
import { heightOf, SAMPLE_MS, ValueHistory } from './history';

/** Most rows whose history is kept: each is watched all the time, also beyond the screen. */
export const MOST_ROWS = 500;

/** Keeps the last minute of these variables while `on`; null while it is off. */
export function useHistory(runtimeId: string | null, expressions: readonly string[], on: boolean): ValueHistory | null {
  const wanted = useMemo(() => (on ? expressions.slice(0, MOST_ROWS) : []), [expressions, on]);
  useWatched(on ? runtimeId : null, wanted, SAMPLE_MS);
  const history = useMemo(() => (on && runtimeId !== null ? new ValueHistory() : null), [on, runtimeId]);
  const now = useRef(wanted);
  useEffect(() => {
    now.current = wanted;
  });
  useEffect(() => {
    const board = channelOf(runtimeId)?.board;
    if (history === null || board === undefined) return;
    const note = () =>
      history.note(
        performance.now(),
        new Map(now.current.map((expression) => [expression, heightOf(board.get(expression)?.value ?? null)])),
      );
    const timer = setInterval(note, SAMPLE_MS);
    return () => clearInterval(timer);
  }, [history, runtimeId]);
  return history;
}
