/** The undo steps of forms, kept in this browser for the next visit; they count only for the data that they lead to. */
import { useEffect, useRef } from 'react';
import { useSession } from '@/session/session';
import { KeptSteps } from '@/text/undoSteps';

/** Data before and behind; `of` is what is between them, undefined where nothing was changed here yet. */
export interface Steps<Data> {
  readonly past: readonly Data[];
  readonly future: readonly Data[];
  readonly of?: Data;
}

interface Kept {
  of: string;
  past: unknown[];
}

const NO_STEPS = { past: [], future: [] };
/** The last steps that are kept; those of a visit are more. */
const MOST_KEPT = 30;
/** Data with a picture are large, and the browser has some five million characters for all that is kept there. */
const MOST_CHARACTERS = 400_000;

function isKept(value: unknown): value is Kept {
  const kept = value as Partial<Kept> | null;
  return typeof kept?.of === 'string' && Array.isArray(kept.past);
}

function store(): KeptSteps<Kept> {
  return new KeptSteps(localStorage, isKept);
}

/** What a form holds, in one order whoever wrote it. */
function words(data: unknown): string {
  return JSON.stringify(data, (_, value: unknown) =>
    value !== null && typeof value === 'object' && !Array.isArray(value)
      ? Object.fromEntries(Object.entries(value).sort(([a], [b]) => (a < b ? -1 : 1)))
      : value,
  );
}

/** The last steps that there is room for. */
export function lastSteps<Data>(past: readonly Data[]): Data[] {
  const kept: Data[] = [];
  let characters = 0;
  for (const data of past.slice(-MOST_KEPT).reverse()) {
    characters += JSON.stringify(data).length;
    if (characters > MOST_CHARACTERS) break;
    kept.unshift(data);
  }
  return kept;
}

/**
 * Takes up the steps of an earlier visit, stores those of this one, and forgets them when the data are others than the
 * last step made: then somebody else has changed them, and undo must not take that back.
 */
export function useKeptSteps<Data>(
  projectId: string,
  objectId: string,
  data: Data | undefined,
  steps: Steps<Data>,
  set: (steps: Steps<Data>) => void,
): void {
  const user = useSession((state) => state.user?.id ?? '');
  const begun = useRef(false);
  useEffect(() => {
    if (data === undefined) return;
    if (!begun.current) {
      begun.current = true;
      const kept = store().read(user, projectId, objectId);
      if (kept !== null && kept.past.length > 0 && kept.of === words(data))
        set({ past: kept.past as Data[], future: [], of: data });
      return;
    }
    if (steps.of === undefined) return;
    if (words(steps.of) !== words(data)) {
      set(NO_STEPS);
      store().write(user, projectId, objectId, null, Date.now());
      return;
    }
    const past = lastSteps(steps.past);
    store().write(user, projectId, objectId, past.length ? { of: words(data), past } : null, Date.now());
  }, [user, projectId, objectId, data, steps, set]);
}
