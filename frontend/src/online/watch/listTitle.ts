/** Names of watch lists. Pure functions. */
import type { t as Text } from '@/i18n';
import type { WatchList } from './model';

const LONGEST = 60;

export function listTitle(t: typeof Text, list: Pick<WatchList, 'id' | 'name'>): string {
  return list.name ?? t('watch.title', { number: list.id });
}

/** Why a list cannot have this name beside lists of other names. */
export function nameFault(name: string, taken: readonly string[]): 'empty' | 'long' | 'taken' | null {
  const wanted = name.trim();
  if (wanted === '') return 'empty';
  if (wanted.length > LONGEST) return 'long';
  return taken.some((other) => other.toUpperCase() === wanted.toUpperCase()) ? 'taken' : null;
}

/** A name that is free: the wanted one, or with the next number behind it. */
export function freeName(wanted: string, taken: readonly string[]): string {
  for (let number = 2; ; number += 1) {
    const name =
      number === 2 && nameFault(wanted, taken) === null ? wanted : `${wanted.slice(0, 50)} ${String(number)}`;
    if (nameFault(name, taken) === null) return name;
  }
}
