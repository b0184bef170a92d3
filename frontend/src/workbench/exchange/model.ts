/** Imports as data: places, the report, the files to read. Pure functions. */
import { hasRole } from '@/project/kinds';
import type { ImportEntry, ImportFormats, ObjectSummary } from '@/api/types';
import { t } from '@/i18n';
import { childrenOf, forestOf, lineage, type Forest } from '@/project/tree';

export interface Place {
  /** Id of the object, or `pous` for the POUs view. */
  id: string;
  names: readonly string[];
}

/** Where imported objects can go: applications, the POUs view, and the folders in them. */
export function placesOf(objects: readonly ObjectSummary[]): Place[] {
  const forest: Forest = forestOf(objects);
  const places: Place[] = [];
  const folders = (parent: string | null, names: readonly string[]) => {
    for (const child of childrenOf(forest, parent)) {
      if (!hasRole(child, 'folder')) continue;
      places.push({ id: child.id, names: [...names, child.name] });
      folders(child.id, [...names, child.name]);
    }
  };
  for (const application of objects.filter((object) => hasRole(object, 'application'))) {
    const names = lineage(forest, application.id)
      .filter((object) => hasRole(object, 'application') || hasRole(object, 'device'))
      .map((object) => object.name)
      .reverse();
    places.push({ id: application.id, names });
    folders(application.id, names);
  }
  places.push({ id: 'pous', names: [] });
  folders(null, []);
  return places;
}

/** The place that fits the selected object best: itself, what it stands in, else the first application. */
export function proposedPlace(
  places: readonly Place[],
  objects: readonly ObjectSummary[],
  selected: ObjectSummary | undefined,
  applicationId: string | null,
): string {
  const ids = new Set(places.map((place) => place.id));
  const line = selected ? lineage(objects, selected.id) : [];
  const inView = line.find((object) => ids.has(object.id))?.id;
  if (inView) return inView;
  if (line.length > 0 && !hasRole(line.at(-1), 'device')) return 'pous';
  return applicationId !== null && ids.has(applicationId) ? applicationId : (places[0]?.id ?? 'pous');
}

export const OUTCOMES = ['imported', 'changed', 'overwritten', 'merged', 'kept', 'skipped', 'refused'] as const;
export type Outcome = ImportEntry['outcome'];

export function shownEntries(
  entries: readonly ImportEntry[],
  hidden: ReadonlySet<Outcome>,
  search: string,
): ImportEntry[] {
  const text = search.trim().toLowerCase();
  return entries.filter(
    (entry) =>
      !hidden.has(entry.outcome) &&
      (!text || `${entry.object} ${entry.text} ${entry.source}`.toLowerCase().includes(text)),
  );
}

export function countOutcomes(entries: readonly ImportEntry[]): Record<Outcome, number> {
  const count = { imported: 0, changed: 0, overwritten: 0, merged: 0, kept: 0, skipped: 0, refused: 0 };
  for (const entry of entries) count[entry.outcome]++;
  return count;
}

export function placeText(entry: Pick<ImportEntry, 'source' | 'line'>): string {
  return entry.line == null ? entry.source : `${entry.source}:${entry.line}`;
}

/** The report as text, in the language of the user: one line an entry, as `tappet import` prints it. */
export function reportText(entries: readonly ImportEntry[]): string {
  const lines = entries.map((entry) => {
    const name = entry.object ? ` ${entry.object}` : '';
    return `${placeText(entry)}: ${t(`exchange.outcome.${entry.outcome}`)}${name}${entry.text ? `: ${entry.text}` : ''}`;
  });
  return lines.map((line) => `${line}\n`).join('');
}

/** Of a folder: what can be read, or all of it when it is a project of our own; hidden files never. */
export function readable({ endings, project_file }: ImportFormats, paths: readonly string[]): string[] {
  const visible = paths.filter((path) => !path.split('/').some((part) => part.startsWith('.')));
  const own = visible.some((path) => path.split('/').at(-1) === project_file);
  return own ? visible : visible.filter((path) => endings.some((ending) => path.toLowerCase().endsWith(ending)));
}
