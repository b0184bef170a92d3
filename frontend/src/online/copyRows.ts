/** Chosen rows of an online table for the clipboard. */
import { api } from '@/api/client';
import { guard } from '@/ui/notices';
import { isVariable, type OnlineRow } from './treeRows';

/** One row a line with tabs between, as tables of other programs take it: path, type, exact value. */
export function rowsAsText(rows: readonly OnlineRow[], literals: ReadonlyMap<string, string | null>): string {
  return rows
    .filter(({ expression }) => expression !== '')
    .map((row) => [row.expression, row.type ?? '', literals.get(row.expression) ?? ''].join('\t'))
    .join('\n');
}

/**
 * Copies rows with their values, or without any while logged out.
 *
 * The values are read for it, all in one cycle: those of rows beyond the screen are not known here.
 */
export async function copyRows(runtimeId: string | null, rows: readonly OnlineRow[]): Promise<void> {
  const expressions = rows.filter((row) => row.expression !== '' && isVariable(row)).map((row) => row.expression);
  const literals = new Map<string, string | null>();
  if (runtimeId !== null && expressions.length > 0) {
    const { values } = await api.post('/api/v1/runtimes/{runtime_id}/values/read', {
      params: { path: { runtime_id: runtimeId } },
      body: { expressions },
    });
    values.forEach((value, at) => literals.set(expressions[at] ?? value.expression, value.literal));
  }
  await navigator.clipboard.writeText(rowsAsText(rows, literals));
}

/** Copies rows; what goes wrong is shown. */
export function copyChosen(runtimeId: string | null, rows: readonly OnlineRow[]): void {
  void guard(() => copyRows(runtimeId, rows));
}
