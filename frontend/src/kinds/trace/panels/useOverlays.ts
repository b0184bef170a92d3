import { useQueries } from '@tanstack/react-query';
import { useEffect, useMemo, useReducer } from 'react';
import { RunData } from '../data/runData';
import { recordingQuery, storedShape } from '../data/useRuns';
import type { OverlayRun } from '../Diagrams';
import type { Overlay } from '../traceView';

/** The recordings that are drawn over what is shown. */
export function useOverlays(overlays: readonly Overlay[]): OverlayRun[] {
  const [drawn, draw] = useReducer((count: number) => count + 1, 0);
  const answers = useQueries({ queries: overlays.map(({ id }) => recordingQuery(id)) });
  const loaded = answers.flatMap(({ data }) => (data ? [data] : []));
  const key = loaded.map(({ id }) => id).join(' ');
  const runs = useMemo(
    () =>
      loaded.map((recording) => {
        const { id, title } = recording;
        return { id, title, run: new RunData({ kind: 'stored', id }, storedShape(recording)) };
      }),
    // The recordings of one key are the same.
    // eslint-disable-next-line react-hooks/exhaustive-deps
    [key],
  );
  useEffect(() => {
    const ends = runs.map(({ run }) => {
      run.open();
      return run.subscribe(draw);
    });
    return () => {
      ends.forEach((end) => end());
      runs.forEach(({ run }) => run.close());
    };
  }, [runs]);
  return useMemo(
    () =>
      overlays.flatMap(({ id, shift }) => {
        const found = runs.find((one) => one.id === id);
        return found ? [{ run: found.run, shift, title: found.title, drawn }] : [];
      }),
    [overlays, runs, drawn],
  );
}
