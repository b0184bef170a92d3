import { useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import { t, useText } from '@/i18n';
import { guard, notify } from '@/ui/notices';
import { commandContext } from '@/workbench/context';
import { mayEdit } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import { order, type Choices, type Comparison } from './comparison';

const NONE: Choices = new Map();

export interface Merge {
  choices: Choices;
  /** Null: nothing can be taken over. */
  choose: ((choices: Choices) => void) | null;
  /** Why nothing can be taken over now, or null. */
  refused: string | null;
  count: number;
  /** Takes the choice over as one change of the project; true when that was done. */
  merge: () => Promise<boolean>;
}

/** What was chosen of a comparison, and taking it over. Another comparison begins with nothing chosen. */
export function useMerge(projectId: string, comparison: Comparison | undefined, done: () => Promise<unknown>): Merge {
  const say = useText();
  const [chosen, setChosen] = useState<{ id: string; choices: Choices } | null>(null);
  const choices = chosen !== null && chosen.id === comparison?.id ? chosen.choices : NONE;
  const allowed = mayEdit(commandContext());
  const possible = comparison?.can_merge === true && allowed === true;
  const refused =
    allowed !== true
      ? reasonText(allowed)
      : comparison?.can_merge === false
        ? say('compare.earlier')
        : choices.size === 0
          ? say('compare.nothingChosen')
          : null;
  const merge = async () => {
    if (comparison === undefined) return false;
    const path = { project_id: projectId, comparison_id: comparison.id };
    const merged = await guard(async () => {
      await api.post('/api/v1/projects/{project_id}/comparisons/{comparison_id}/merge', {
        params: { path },
        body: { take: order(choices, comparison.differences), comment: '' },
      });
      setChosen(null);
      await queryClient.invalidateQueries({ queryKey: keys.project(projectId) });
      await done();
      notify({ tone: 'ok', title: t('compare.taken', { count: choices.size }), text: t('compare.takenText') });
      return true;
    });
    if (merged !== true) await done();
    return merged === true;
  };
  const choose = (next: Choices) => setChosen(comparison ? { id: comparison.id, choices: next } : null);
  return { choices, choose: possible ? choose : null, refused, count: choices.size, merge };
}
