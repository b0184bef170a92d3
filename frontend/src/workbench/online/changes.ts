/** What an online change does to variables, as rows of a table. Pure functions. */
import type { LoginAnswer } from '@/api/types';

export type ChangedVariable = LoginAnswer['changes'][number];
export type Effect = ChangedVariable['effect'];

/** In the order of their weight for who decides. */
export const EFFECTS = [
  'lost',
  'cleared',
  'initialised',
  'converted',
  'kept',
  'follows',
  'moved',
] as const satisfies readonly Effect[];

export function effectCounts(changes: readonly ChangedVariable[]): Record<Effect, number> {
  const counts = { lost: 0, cleared: 0, initialised: 0, converted: 0, kept: 0, follows: 0, moved: 0 };
  for (const { effect } of changes) counts[effect] += 1;
  return counts;
}

const QUIET: readonly Effect[] = ['follows', 'moved'];

/** Variables that merely lie somewhere else, and pointers to them, say little where others lose something. */
export function hiddenAtFirst(changes: readonly ChangedVariable[]): ReadonlySet<Effect> {
  const counts = effectCounts(changes);
  const quiet = QUIET.filter((effect) => counts[effect] > 0);
  const all = quiet.reduce((sum, effect) => sum + counts[effect], 0);
  return new Set(all < changes.length ? quiet : []);
}

export function shownChanges(
  changes: readonly ChangedVariable[],
  hidden: ReadonlySet<Effect>,
  search: string,
): readonly ChangedVariable[] {
  const wanted = search.trim().toLowerCase();
  return changes.filter(
    ({ path, type, effect }) =>
      !hidden.has(effect) && (path.toLowerCase().includes(wanted) || type.toLowerCase().includes(wanted)),
  );
}

/** An expression that names one variable: of a range of elements the first. */
export function declaredAt(path: string): string {
  return path.replace(/(-?\d+)\.\.-?\d+/g, '$1');
}

export function typeText({ before, type }: ChangedVariable): string {
  return before !== '' && before !== type ? `${before} → ${type}` : type;
}
