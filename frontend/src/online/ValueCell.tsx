import { useLayoutEffect, useRef } from 'react';
import { useEditorSettings } from '@/text/settings';
import { useText } from '@/i18n';
import type { LiveValue } from './board';
import { channelOf } from './connections';
import { formatAll, formatLiteral, formatShort } from './format';
import { markFresh, unmarkFresh } from './freshMarks';
import { isLeaf, valueKind } from './item';
import styles from './OnlineTable.module.css';
import { isExpandable, type OnlineRow } from './treeRows';
import { useForced, useLiveItem } from './useLive';

interface ValueCellProps {
  runtimeId: string | null;
  row: OnlineRow;
  lost: boolean;
}

/** The live value of a row: forced ones carry an F, constants their mark, changed ones glow for a second. */
export function ValueCell({ runtimeId, row, lost }: ValueCellProps) {
  const t = useText();
  const item = useLiveItem(runtimeId, row.expression);
  const forced = useForced(runtimeId, row.expression);
  if (isExpandable(row) || item === null) return null;
  if (item.error) return <span className={styles.invalid}>{item.error}</span>;
  if (!isLeaf(valueKind(item))) return <span className={styles.unknown}>…</span>;
  return (
    <LiveText runtimeId={runtimeId} expression={row.expression} forced={forced} lost={lost}>
      {item.flags?.includes('CONSTANT') === true && <i className={styles.constant}>const</i>}
      {forced && (
        <i className={styles.forced} aria-label={t('online.forced')}>
          F
        </i>
      )}
    </LiveText>
  );
}

interface LiveTextProps {
  runtimeId: string | null;
  expression: string;
  forced: boolean;
  lost: boolean;
  /** Marks in front of the value. */
  children: React.ReactNode;
}

/** Writes each value into the page itself: React draws a cell once, not ten times a second. */
function LiveText({ runtimeId, expression, forced, lost, children }: LiveTextProps) {
  const t = useText();
  const format = useEditorSettings((settings) => settings.numberFormat);
  const frame = useRef<HTMLSpanElement>(null);
  const text = useRef<HTMLSpanElement>(null);
  const board = channelOf(runtimeId)?.board ?? null;

  useLayoutEffect(() => {
    const [shell, place] = [frame.current, text.current];
    if (shell === null || place === null || board === null) return;
    const show = () => {
      const live = board.get(expression);
      const shown = live === null || live.value === null ? '…' : textOf(live);
      if (place.textContent !== shown) place.textContent = shown;
      const state = typeof live?.value === 'boolean' ? String(live.value) : undefined;
      if (state === undefined) delete shell.dataset.state;
      else if (shell.dataset.state !== state) shell.dataset.state = state;
      if (live !== null && !lost) markFresh(shell, live.changedAt);
    };
    const textOf = ({ value, item }: LiveValue) =>
      value === null
        ? ''
        : valueKind(item) === 'string'
          ? formatLiteral(value, item)
          : formatShort(value, item, format, 80);
    show();
    const stop = board.subscribe(expression, show);
    return () => {
      stop();
      unmarkFresh(shell);
    };
  }, [board, expression, format, lost]);

  // All formats are written only for who points at the value.
  const describe = () => {
    const live = board?.get(expression) ?? null;
    if (frame.current === null || live === null || live.value === null) return;
    const all = formatAll(live.value, live.item);
    const lines = all.map(({ format: f, text }) => (all.length > 1 ? `${t(`online.format.${f}`)}: ${text}` : text));
    frame.current.title = [...lines, live.item.type].join('\n');
  };
  return (
    <span ref={frame} className={styles.value} data-forced={forced || undefined} onPointerEnter={describe}>
      {children}
      <span ref={text} />
    </span>
  );
}
