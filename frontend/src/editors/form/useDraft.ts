import { useCallback, useEffect, useMemo, useRef, useState } from 'react';
import { saveObject, StaleObject, useObject } from '@/api/queries';
import type { Check } from '@/api/objects';
import type { ObjectSummary, ProjectObject } from '@/api/types';
import { t } from '@/i18n';
import { displayName } from '@/project/objectName';
import type { Enablement, Handlers } from '@/workbench/commands';
import type { CommandContext } from '@/workbench/context';
import { useCommandContext } from '@/workbench/useCommandContext';
import { confirm } from '@/ui/dialogs';
import { explain, notifyError } from '@/ui/notices';
import { mayEdit } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import { setDirty } from '@/workbench/selection';
import { useHandlers } from '@/workbench/useHandlers';
import { useKeptSteps, type Steps } from './keptSteps';

const SAVE_AFTER_MS = 700;
const NO_OTHERS: Handlers = {};

interface Unsaved<Data> {
  data: Data;
  /** The stored revision that it was made from. */
  revision: number;
}

export interface Draft<Data> {
  object: ObjectSummary | undefined;
  /** What the form shows: the stored data with the changes made here. */
  data: Data | undefined;
  /** Why nothing can be changed, or null. */
  readOnly: string | null;
  /** The server's words about data it did not take; null when all is stored. */
  refused: string | null;
  error: unknown;
  change: (data: Data) => void;
}

/**
 * The data of an object being edited in a form; `check` demands their shape. Changes are saved by themselves a moment later, and at once by
 * Save; data that the form marks as faulty (`valid` false) wait. Undo and redo go through
 * one's own changes, also after a reload. `others` are further acts of the view, always the same object; `mayChange` says
 * who may change the data, by default an engineer who is logged out.
 */
export function useDraft<Data extends ProjectObject['data']>(
  panelId: string,
  projectId: string,
  objectId: string,
  check: Check<Data>,
  valid: (data: Data) => boolean,
  others: Handlers = NO_OTHERS,
  mayChange: (context: CommandContext) => Enablement = mayEdit,
): Draft<Data> {
  const { data: object, error } = useObject(projectId, objectId, check);
  const [draft, setDraft] = useState<Unsaved<Data> | null>(null);
  const [refused, setRefused] = useState<string | null>(null);
  const [history, setHistory] = useState<Steps<Data>>({ past: [], future: [] });
  const allowed = mayChange(useCommandContext());
  const readOnly = allowed === true ? null : reasonText(allowed);
  const data = draft?.data ?? object?.data;
  useKeptSteps(projectId, objectId, data, history, setHistory);
  const latest = useRef({ draft, object, valid });
  useEffect(() => {
    latest.current.object = object;
    latest.current.valid = valid;
  });
  // Known at once and not with the next picture: Build and Login ask right after Save whether all is stored.
  const keep = useCallback(
    (next: Unsaved<Data> | null) => {
      latest.current.draft = next;
      setDraft(next);
      setDirty(panelId, next !== null);
    },
    [panelId],
  );

  const saveOnce = useCallback(async () => {
    const { draft: present, object: base, valid: fits } = latest.current;
    if (!present || !base || !fits(present.data)) return;
    try {
      const saved = await saveObject(projectId, objectId, present.revision, present.data);
      setRefused(null);
      // Typed on while it was being saved: the newer draft stands on the revision just made.
      const now = latest.current.draft;
      keep(now === null || now.data === present.data ? null : { ...now, revision: saved.revision });
      // The server may say the same in other words; it is our own step all the same.
      if (now === null || now.data === present.data)
        setHistory((steps) => (steps.of === undefined ? steps : { ...steps, of: saved.data as Data }));
    } catch (failure) {
      if (failure instanceof StaleObject) {
        const mine = await confirm({
          title: t('conflict.title', { name: displayName(failure.current) }),
          text: t('conflict.text'),
          action: t('conflict.overwrite'),
        });
        keep(mine ? { data: present.data, revision: failure.current.revision } : null);
      } else {
        setRefused(explain(failure).text ?? explain(failure).title);
        notifyError(failure);
      }
    }
  }, [projectId, objectId, keep]);

  // One request at a time: a second one on the same revision would be a conflict with oneself.
  const running = useRef<Promise<void> | null>(null);
  const save = useCallback(async () => {
    while (running.current) await running.current;
    running.current = saveOnce().finally(() => {
      running.current = null;
    });
    await running.current;
  }, [saveOnce]);

  useEffect(() => {
    if (!draft) return;
    const timer = setTimeout(() => void save(), SAVE_AFTER_MS);
    return () => clearTimeout(timer);
  }, [draft, save]);

  const set = useCallback(
    (next: Data) => {
      const { draft: present, object: base } = latest.current;
      if (base) keep({ data: next, revision: present?.revision ?? base.revision });
    },
    [keep],
  );

  const change = useCallback(
    (next: Data) => {
      const before = latest.current.draft?.data ?? latest.current.object?.data;
      if (before === undefined) return;
      setHistory((steps) => ({ past: [...steps.past, before].slice(-100), future: [], of: next }));
      set(next);
    },
    [set],
  );

  // Not as `Data`: the union of the dependencies of all kinds is more than the compiler takes.
  const present: unknown = data;
  const handlers = useMemo(() => {
    const step = (from: 'past' | 'future', to: 'past' | 'future', take: number) => () => {
      const target = history[from].at(take);
      if (target === undefined || present === undefined) return;
      const rest = take === 0 ? history[from].slice(1) : history[from].slice(0, -1);
      const now = present as Data;
      const kept = to === 'future' ? [now, ...history[to]] : [...history[to], now];
      setHistory({ ...history, [from]: rest, [to]: kept, of: target });
      set(target);
    };
    const blocked = allowed !== true ? allowed : null;
    return {
      ...others,
      'file.save': { run: save },
      'edit.undo': {
        run: step('past', 'future', -1),
        enabled: blocked ?? (history.past.length ? (true as const) : ('reason.nothingToUndo' as const)),
      },
      'edit.redo': {
        run: step('future', 'past', 0),
        enabled: blocked ?? (history.future.length ? (true as const) : ('reason.nothingToRedo' as const)),
      },
    };
  }, [history, present, save, set, allowed, others]);
  useHandlers(panelId, handlers);

  return { object, data, readOnly, refused, error, change };
}
