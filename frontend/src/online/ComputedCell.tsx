import { useCallback, useMemo, useSyncExternalStore } from 'react';
import { useText } from '@/i18n';
import { useEditorSettings, type NumberFormat } from '@/text/settings';
import { operandOf, resultItem, type Computed } from './computed';
import { channelOf } from './connections';
import { formatShort } from './format';
import styles from './OnlineTable.module.css';

interface ComputedCellProps {
  runtimeId: string | null;
  computed: Computed;
  lost: boolean;
  format: NumberFormat | undefined;
}

/** The value of an expression over variables, which somebody must watch. */
export function ComputedCell({ runtimeId, computed, lost, format }: ComputedCellProps) {
  const t = useText();
  const general = useEditorSettings((settings) => settings.numberFormat);
  const board = channelOf(runtimeId)?.board ?? null;
  const subscribe = useCallback(
    (listener: () => void) => {
      const stops = computed.operands.map((operand) => board?.subscribe(operand, listener));
      return () => stops.forEach((stop) => stop?.());
    },
    [board, computed],
  );
  const read = useCallback(() => {
    const result = computed.evaluate((operand) => {
      const live = board?.get(operand);
      return live == null ? null : operandOf(live.value, live.item);
    });
    return result === null ? null : formatShort(result, resultItem(result), format ?? general, 80);
  }, [board, computed, format, general]);
  const text = useSyncExternalStore(subscribe, read);
  const wrong = useWrong(board, computed, subscribe);
  if (runtimeId === null) return null;
  if (wrong !== null) return <span className={styles.invalid}>{wrong}</span>;
  return (
    <span
      className={styles.value}
      data-tone={lost ? 'lost' : text === 'TRUE' ? 'true' : text === 'FALSE' ? 'false' : 'plain'}
      title={text === null ? t('watch.noResult') : undefined}
    >
      {text ?? '…'}
    </span>
  );
}

/** What the server says against the first variable that it does not know. */
function useWrong(
  board: { get: (expression: string) => { item: { error?: string | null } } | null } | null,
  computed: Computed,
  subscribe: (listener: () => void) => () => void,
): string | null {
  const read = useMemo(
    () => () => computed.operands.map((operand) => board?.get(operand)?.item.error).find(Boolean) ?? null,
    [board, computed],
  );
  return useSyncExternalStore(subscribe, read);
}
