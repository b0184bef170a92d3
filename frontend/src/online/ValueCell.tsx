import { useEffect, useState } from 'react';
import { useEditorSettings } from '@/text/settings';
import { useText } from '@/i18n';
import { formatAll, formatLiteral, formatShort } from './format';
import { isLeaf, valueKind } from './item';
import styles from './OnlineTable.module.css';
import { isExpandable, type OnlineRow } from './treeRows';
import { useForced, useLiveValue } from './useLive';

const CHANGED_MS = 1000;

interface ValueCellProps {
  runtimeId: string | null;
  row: OnlineRow;
  lost: boolean;
}

/** The live value of a row: forced ones carry an F, constants their mark, changed ones glow for a second. */
export function ValueCell({ runtimeId, row, lost }: ValueCellProps) {
  const t = useText();
  const live = useLiveValue(runtimeId, row.expression);
  const forced = useForced(runtimeId, row.expression);
  const format = useEditorSettings((settings) => settings.numberFormat);
  const fresh = useFresh(live?.changedAt ?? 0);
  if (isExpandable(row) || live === null) return null;
  if (live.item.error) return <span className={styles.invalid}>{live.item.error}</span>;
  const { item, value } = live;
  if (value === null || !isLeaf(valueKind(item))) return <span className={styles.unknown}>…</span>;
  const all = formatAll(value, item);
  const title = [
    ...all.map(({ format: f, text }) => (all.length > 1 ? `${t(`online.format.${f}`)}: ${text}` : text)),
    item.type,
  ].join('\n');
  const state = typeof value === 'boolean' ? (value ? 'true' : 'false') : undefined;
  return (
    <span
      className={styles.value}
      data-state={state}
      data-forced={forced || undefined}
      data-fresh={(fresh && !lost) || undefined}
      title={title}
    >
      {item.flags?.includes('CONSTANT') === true && <i className={styles.constant}>const</i>}
      {forced && (
        <i className={styles.forced} aria-label={t('online.forced')}>
          F
        </i>
      )}
      <span>{valueKind(item) === 'string' ? formatLiteral(value, item) : formatShort(value, item, format, 80)}</span>
    </span>
  );
}

/** True for a second after `changedAt`. */
function useFresh(changedAt: number): boolean {
  const [fresh, setFresh] = useState(false);
  useEffect(() => {
    const left = changedAt + CHANGED_MS - performance.now();
    if (changedAt === 0 || left <= 0) return;
    const on = setTimeout(() => setFresh(true));
    const off = setTimeout(() => setFresh(false), left);
    return () => {
      clearTimeout(on);
      clearTimeout(off);
    };
  }, [changedAt]);
  return fresh;
}
