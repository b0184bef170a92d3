/** Values of all rows of a list in one cycle: kept, compared, written to a file. */
import { api } from '@/api/client';
import type { Schemas } from '@/api/types';
import type { Source } from '../computed/computed';
import { literalOf } from '../computed/literals';
import { formatLiteral } from '../format';
import { expressionKey, type PlcValue } from '../item';
import { isExpandable, type OnlineRow } from '../treeRows';

export interface Snapshot {
  readonly at: Date;
  /** Literal by expression; null for a row without a value. */
  readonly literals: ReadonlyMap<string, string | null>;
}

type Value = Schemas['Value'];

const hasValue = (row: OnlineRow) =>
  row.expression !== '' && (row.computed !== undefined || (row.valueless !== true && !isExpandable(row)));

/** Reads all rows that have a value, in one order: the controller answers with the values of one cycle. */
export async function takeSnapshot(runtimeId: string, rows: readonly OnlineRow[]): Promise<Snapshot> {
  const wanted = rows.filter(hasValue);
  const expressions = [...new Set(wanted.flatMap((row) => row.computed?.operands ?? [row.expression]))];
  const at = new Date();
  if (expressions.length === 0) return { at, literals: new Map() };
  const { values } = await api.post('/api/v1/runtimes/{runtime_id}/values/read', {
    params: { path: { runtime_id: runtimeId } },
    body: { expressions },
  });
  return { at, literals: literalsOf(wanted, expressions, values) };
}

/** The literal of each row from the values that were read. */
export function literalsOf(
  rows: readonly OnlineRow[],
  expressions: readonly string[],
  values: readonly Value[],
): Map<string, string | null> {
  const read = new Map(expressions.map((expression, index) => [expression, values[index]]));
  return new Map(
    rows.map((row) => {
      if (row.computed === undefined) return [expressionKey(row.expression), read.get(row.expression)?.literal ?? null];
      const result = row.computed.evaluate((operand) => sourceOf(read.get(operand)));
      return [expressionKey(row.expression), result.kind === 'value' ? formatLiteral(result.value, result.item) : null];
    }),
  );
}

function sourceOf(value: Value | undefined): Source | null {
  if (value === undefined) return null;
  const { type, kind, size, base, error } = value;
  const item = { type: type ?? '', kind: kind ?? '', size: size ?? 0, enum: value.enum ?? undefined, base: base ?? '' };
  return { value: exactValue(value), item: { ...item, error } };
}

/** JSON rounds whole numbers beyond 53 bit and knows neither infinity nor NaN: there the literal says what it is. */
function exactValue({ value, literal, kind }: Value): PlcValue | null {
  if (typeof value === 'boolean' || typeof value === 'string') return value;
  if (kind === 'real') return typeof value === 'number' ? value : special(literal ?? '');
  if (typeof value !== 'number') return null;
  if (Number.isSafeInteger(value)) return value;
  const exact = literalOf((literal ?? '').replace(/^-/, ''))?.value;
  if (typeof exact !== 'bigint') return null;
  return value < 0 ? -exact : exact;
}

function special(literal: string): number | null {
  if (/nan/i.test(literal)) return NaN;
  return /inf/i.test(literal) ? (literal.startsWith('-') ? -Infinity : Infinity) : null;
}

export const literalIn = (snapshot: Snapshot, row: OnlineRow): string | null =>
  snapshot.literals.get(expressionKey(row.expression)) ?? null;

/** Whether a row has another value in the newer one of two snapshots. */
export function differs(before: Snapshot | undefined, after: Snapshot | undefined, row: OnlineRow): boolean {
  if (before === undefined || after === undefined || row.expression === '') return false;
  const key = expressionKey(row.expression);
  return before.literals.has(key) && after.literals.has(key) && literalIn(before, row) !== literalIn(after, row);
}

const quoted = (text: string) => (/[",\n;]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** One row a line: expression, type, and its value in each snapshot, whose moments stand in the first line. */
export function snapshotsCsv(rows: readonly OnlineRow[], snapshots: readonly Snapshot[], comment = true): string {
  const head = ['Expression', 'Type', ...snapshots.map((one) => one.at.toISOString()), ...(comment ? ['Comment'] : [])];
  const lines = rows
    .filter(hasValue)
    .map((row) => [
      row.expression,
      row.type ?? '',
      ...snapshots.map((one) => literalIn(one, row) ?? ''),
      ...(comment ? [row.comment ?? ''] : []),
    ]);
  return [head, ...lines].map((line) => line.map(quoted).join(',')).join('\r\n') + '\r\n';
}
