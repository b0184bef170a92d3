/** The log as data. Pure functions. */
import type { LogEntry, Severity } from '@/api/types';

const MOST = 5000;

/** Runtimes name severities in their own words. */
export function levelOf(severity: string): Severity {
  const text = severity.toLowerCase();
  if (text.startsWith('err') || text.startsWith('exc') || text.startsWith('crit')) return 'error';
  return text.startsWith('warn') ? 'warning' : 'info';
}

/** How many lines there are of each severity. */
export function countByLevel(entries: readonly LogEntry[]): Record<Severity, number> {
  const count = { error: 0, warning: 0, info: 0 };
  for (const entry of entries) count[levelOf(entry.severity)]++;
  return count;
}

/** Known lines and new ones, each once; the oldest fall out of a very long log. */
export function merged(known: readonly LogEntry[], fresh: readonly LogEntry[]): LogEntry[] {
  const last = known.at(-1)?.id ?? -1;
  return [...known, ...fresh.filter((entry) => entry.id > last)].slice(-MOST);
}

/** Newest first, without the hidden levels, with the searched text. */
export function shownEntries(entries: readonly LogEntry[], hidden: ReadonlySet<Severity>, search: string): LogEntry[] {
  const wanted = search.trim().toLowerCase();
  return entries
    .filter((entry) => !hidden.has(levelOf(entry.severity)))
    .filter((entry) => !wanted || `${entry.message} ${entry.component}`.toLowerCase().includes(wanted))
    .reverse();
}

/** Lines as CSV with a head. Cells that a spreadsheet would take for a formula get an apostrophe. */
export function logCsv(entries: readonly LogEntry[]): string {
  const cell = (text: string) => `"${text.replace(/"/g, '""').replace(/^([=+\-@])/, "'$1")}"`;
  const lines = entries.map((entry) => [entry.at, entry.severity, entry.component, entry.message].map(cell).join(','));
  return ['time,severity,component,message', ...lines].join('\r\n') + '\r\n';
}
