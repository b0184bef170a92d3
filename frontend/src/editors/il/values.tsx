import { useEffect, useMemo, useState } from 'react';
import { useText } from '@/i18n';
import { channelOf } from '@/online/connections';
import { expressionKey, isLeaf, valueKind } from '@/online/item';
import online from '@/online/OnlineTable.module.css';
import { PreparedCell } from '@/online/PreparedCell';
import { useLiveValue, useWatched } from '@/online/useLive';
import { ValueCell } from '@/online/ValueCell';
import type { OnlineRow } from '@/online/treeRows';
import { useEditorSettings } from '@/text/settings';
import type { MonitorSettings } from '../online/inlineMonitor';
import { executedText } from '../online/pills';
import { codeTokens } from '@/iec/lexer';
import { expressionOf, findVariables, indexExpressions, type VariableUse } from '@/iec/variables';
import styles from './IlTable.module.css';
import { operandTokens } from './instructionList';
import type { IlRow } from './rows';

export interface RowValue {
  /** As it is written in the row. */
  readonly name: string;
  readonly expression: string;
}

/** A variable of a row; without an expression it has no value between two cycles. */
type RowVariable = Omit<RowValue, 'expression'> & { readonly expression: string | null };

/** Those that can be asked for. */
export function withValue(variables: readonly RowVariable[]): RowValue[] {
  return variables.filter((one): one is RowValue => one.expression !== null);
}

const AROUND_ROWS = 20;
const SHOWN_MS = 100;

/** Variables of the rows on screen and what is asked of the runtime for them (ONL-02). */
export function useRowValues(
  settings: MonitorSettings | null,
  text: string,
  rows: readonly IlRow[],
  range: { readonly first: number; readonly last: number },
): ReadonlyMap<number, readonly RowVariable[]> {
  const uses = useMemo(() => usesByRow(text, rows), [text, rows]);
  const board = channelOf(settings?.runtimeId ?? null)?.board ?? null;
  // A moved index means another element: what is asked for changes with it.
  const [moved, setMoved] = useState(0);
  const { values, indices } = useMemo(() => {
    const found = new Map<number, RowVariable[]>();
    const steps: string[] = [];
    if (settings === null) return { values: found, indices: steps };
    const indexValue = (expression: string) => {
      const value = board?.get(expression)?.value;
      return typeof value === 'number' ? value : typeof value === 'bigint' ? Number(value) : null;
    };
    for (let row = Math.max(0, range.first - AROUND_ROWS); row <= range.last + AROUND_ROWS; row += 1) {
      for (const use of uses.get(row) ?? []) {
        steps.push(...indexExpressions(use.path, settings.scope, indexValue));
        const expression = expressionOf(use.path, settings.scope, indexValue);
        found.set(row, [...(found.get(row) ?? []), { name: text.slice(use.start, use.end), expression }]);
      }
    }
    return { values: found, indices: [...new Set(steps)] };
    // `moved` stands for the values of the indices.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [settings, uses, range, text, board, moved]);

  const followed = indices.map(expressionKey).join('\n');
  useEffect(() => {
    if (board === null || followed === '') return;
    const stops = followed.split('\n').map((key) => board.subscribe(key, () => setMoved((count) => count + 1)));
    return () => stops.forEach((stop) => stop());
  }, [board, followed]);
  const wanted = useMemo(
    () => [...new Set([...indices, ...withValue([...values.values()].flat()).map(({ expression }) => expression)])],
    [indices, values],
  );
  useWatched(settings?.runtimeId ?? null, wanted, SHOWN_MS);
  return values;
}

/** Readable variables by the row they stand in. */
export function usesByRow(text: string, rows: readonly IlRow[]): ReadonlyMap<number, readonly VariableUse[]> {
  const found = new Map<number, VariableUse[]>();
  let row = 0;
  for (const use of findVariables(text, operandTokens(text, codeTokens(text)))) {
    while (row < rows.length - 1 && (rows[row]?.end ?? 0) < use.end) row += 1;
    found.set(row, [...(found.get(row) ?? []), use]);
  }
  return found;
}

interface RowValuesProps {
  values: readonly RowVariable[];
  /** The value of the whole operand needs no name beside it. */
  operand: string;
  runtimeId: string;
  lost: boolean;
  /** The row is not the one that runs. */
  stale: boolean;
  /** Literal of a variable right after the statement of the row; null where flow control knows none. */
  executed: (name: string) => string | null;
  onPrepare: (value: RowValue) => void;
}

/** Value, force mark and prepared value of each variable of a row. */
export function RowValues({ values, operand, executed, ...rest }: RowValuesProps) {
  return values.map(({ name, expression }, at) => {
    const named = values.length > 1 && name !== operand;
    const literal = executed(name);
    if (expression !== null)
      return <OneValue key={at} name={name} expression={expression} named={named} literal={literal} {...rest} />;
    return (
      literal !== null && (
        <span key={at} className={styles.value} data-executed>
          {named && <i>{name}</i>}
          <span>{literal}</span>
        </span>
      )
    );
  });
}

type OneValueProps = Omit<RowValuesProps, 'values' | 'operand' | 'executed'> & {
  name: string;
  expression: string;
  named: boolean;
  literal: string | null;
};

function OneValue({ name, expression, named, literal, runtimeId, lost, stale, onPrepare }: OneValueProps) {
  const t = useText();
  const live = useLiveValue(runtimeId, expression);
  const format = useEditorSettings((settings) => settings.numberFormat);
  if (live === null || live.item.error || !isLeaf(valueKind(live.item))) return null;
  const row: OnlineRow = { key: expression, expression, label: name, depth: 0, root: 0, open: undefined };
  return (
    <button
      type="button"
      tabIndex={-1}
      className={styles.value}
      data-stale={stale || undefined}
      data-executed={literal !== null || undefined}
      aria-label={t('il.prepare', { name: expression })}
      onClick={(event) => {
        // The second click of a double click would prepare the next value already.
        if (event.detail < 2) onPrepare({ name, expression });
      }}
      onDoubleClick={(event) => event.stopPropagation()}
    >
      {named && <i>{name}</i>}
      {literal === null ? (
        <ValueCell runtimeId={runtimeId} row={row} lost={lost} />
      ) : (
        <span
          className={online.value}
          data-tone={['TRUE', 'FALSE'].includes(literal) ? literal.toLowerCase() : 'plain'}
        >
          {executedText(literal, live, format)}
        </span>
      )}
      <PreparedCell runtimeId={runtimeId} row={row} />
    </button>
  );
}
