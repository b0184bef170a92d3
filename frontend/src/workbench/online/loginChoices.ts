/** What a login may do about the relation of the two programs, and what it proposes. Pure functions. */
import type { LoginAnswer } from '@/api/types';

export type LoginHow = 'online_change' | 'download' | 'without';

/** The possible answers, the one that loads with the least disturbance first. */
export function loginChoices(relation: LoginAnswer['relation'], mayLoad: boolean): readonly LoginHow[] {
  if (!mayLoad) return ['without'];
  if (relation === 'online_change') return ['online_change', 'download', 'without'];
  return relation === 'download' ? ['download', 'without'] : ['download'];
}

/** The answer that Enter gives; null when each of them would stop a running machine. */
export function proposedChoice(choices: readonly LoginHow[], running: boolean): LoginHow | null {
  return choices.find((how) => !running || how !== 'download') ?? null;
}
