/** The project list as the start page shows it. Pure functions. */
import type { ProjectSummary } from '@/api/types';

export interface ProjectSections {
  recent: ProjectSummary[];
  others: ProjectSummary[];
}

/** Those opened last in that order, then the rest by last change; a search looks at all and knows no sections. */
export function sections(
  projects: readonly ProjectSummary[],
  recentIds: readonly string[],
  search: string,
): ProjectSections {
  const wanted = search.trim().toLowerCase();
  const byChange = [...projects].sort((a, b) => b.modified.localeCompare(a.modified));
  if (wanted) {
    const hits = byChange.filter((project) => `${project.name} ${project.description}`.toLowerCase().includes(wanted));
    return { recent: [], others: hits };
  }
  const recent = recentIds
    .map((id) => projects.find((project) => project.id === id))
    .filter((project) => project !== undefined);
  return { recent, others: byChange.filter((project) => !recent.includes(project)) };
}

const UNITS: readonly [Intl.RelativeTimeFormatUnit, number][] = [
  ['year', 31_536_000],
  ['month', 2_592_000],
  ['week', 604_800],
  ['day', 86_400],
  ['hour', 3600],
  ['minute', 60],
];

/** `3 hours ago`, `yesterday`, in the user's language; null within a minute: browsers have no natural Chinese word for it. */
export function ago(time: string, now: number, language: string): string | null {
  const seconds = (Date.parse(time) - now) / 1000;
  const format = new Intl.RelativeTimeFormat(language, { numeric: 'auto' });
  for (const [unit, length] of UNITS) {
    if (Math.abs(seconds) >= length) return format.format(Math.trunc(seconds / length), unit);
  }
  return null;
}
