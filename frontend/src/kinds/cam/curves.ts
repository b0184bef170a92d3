/** The curves of a cam as the server computes them by the compiled library, asked while the cam is edited. */
import { useCallback, useEffect, useRef, useState } from 'react';
import { api } from '@/api/client';
import type { Schemas } from '@/api/types';
import { useLanguage } from '@/i18n';
import type { CamTable, Values } from './camTable';

export type CamDrawing = Schemas['CamDrawing'];
export type CamFinding = Schemas['CamFinding'];

const SAMPLES = 1000;

export interface Curves {
  /** Those of the cam, or of the one before while the new ones are being computed. */
  drawing: CamDrawing | null;
  /** Why there are none. */
  error: unknown;
  again: () => void;
  /** The values at a position of the master, of the cam as it is. */
  valuesAt: (cam: CamTable, x: number) => Promise<Values>;
}

function ask(project: string, cam: CamTable, samples: number, at: number[]) {
  return api.post('/api/v1/projects/{project_id}/cams/curves', {
    params: { path: { project_id: project } },
    body: { cam, samples, at },
  });
}

/** One question at a time; of the cams that come while it is under way only the last one is asked. */
export function useCurves(project: string, cam: CamTable | undefined): Curves {
  const spoken = useLanguage();
  const [drawing, setDrawing] = useState<CamDrawing | null>(null);
  const [error, setError] = useState<unknown>(null);
  const [round, setRound] = useState(0);
  const state = useRef<{ busy: boolean; waiting: CamTable | null; gone: boolean }>({
    busy: false,
    waiting: null,
    gone: false,
  });
  const run = useCallback(
    async (first: CamTable) => {
      const now = state.current;
      now.waiting = first;
      if (now.busy) return;
      now.busy = true;
      while (now.waiting !== null && !now.gone) {
        const next = now.waiting;
        now.waiting = null;
        try {
          const found = await ask(project, next, SAMPLES, []);
          if (now.gone) return;
          setDrawing(found);
          setError(null);
        } catch (failure) {
          if (now.gone) return;
          setError(failure);
        }
      }
      now.busy = false;
    },
    [project],
  );
  useEffect(() => {
    state.current.gone = false;
    const now = state.current;
    return () => {
      now.gone = true;
      now.busy = false;
    };
  }, []);
  useEffect(() => {
    if (cam) void run(cam);
  }, [cam, run, round, spoken]);
  const valuesAt = useCallback(
    async (of: CamTable, x: number) => {
      const { at } = await ask(project, of, 2, [x]);
      return at[0]!;
    },
    [project],
  );
  return { drawing, error, again: () => setRound((count) => count + 1), valuesAt };
}
