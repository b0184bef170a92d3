import { useCallback, useSyncExternalStore } from 'react';
import { useText } from '@/i18n';
import { useEditorSettings, type NumberFormat } from '@/text/settings';
import type { Computed } from './computed/computed';
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
  // Results are compared as texts: a frame that changes none of them draws nothing.
  const read = useCallback(() => {
    const result = computed.evaluate((operand) => board?.get(operand) ?? null);
    switch (result.kind) {
      case 'value':
        return `=${formatShort(result.value, result.item, format ?? general, 80)}`;
      case 'none':
        return `?${t(result.key, result.values)}`;
      case 'wrong':
        return `!${t(result.key, result.values)}`;
      case 'refused':
        return `!${result.message}`;
      case 'waiting':
        return `?${t('watch.noResult')}`;
    }
  }, [board, computed, format, general, t]);
  const shown = useSyncExternalStore(subscribe, read);
  if (runtimeId === null) return null;
  const text = shown.slice(1);
  if (shown.startsWith('!')) return <span className={styles.invalid}>{text}</span>;
  const tone = lost ? 'lost' : shown === '=TRUE' ? 'true' : shown === '=FALSE' ? 'false' : 'plain';
  const hasValue = shown.startsWith('=');
  return (
    <span className={styles.value} data-tone={tone} title={hasValue ? undefined : text}>
      {hasValue ? text : '…'}
    </span>
  );
}
