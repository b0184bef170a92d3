import { useLayoutEffect, useRef } from 'react';
import { useEditorSettings, type NumberFormat } from '@/text/settings';
import { useText } from '@/i18n';
import type { LiveValue } from './board';
import { channelOf } from './connections';
import { formatAll, formatLiteral, formatShort } from './format';
import { markFresh, unmarkFresh } from './freshMarks';
import { isLeaf, valueKind } from './item';
import styles from './OnlineTable.module.css';
import { isExpandable, type OnlineRow } from './treeRows';
import { useForced, useLiveItem } from './useLive';
import { labelValue, unlabelValue } from './valueLabels';
import type { Tone, ValuePainter, ValuePlace } from './valuePainter';

interface ValueCellProps {
  runtimeId: string | null;
  row: OnlineRow;
  lost: boolean;
  /** What paints the values of the table, and the row's number in it; without one the cell shows its value itself. */
  painter?: ValuePainter;
  index?: number;
  /** Number format of the row; undefined: that of the editors. */
  format?: NumberFormat;
}

/** Pixels that the marks in front of a value take, with the gap behind them; the style sheet has the same. */
const MARK_PX = { constant: 42, forced: 20 };

/** The live value of a row: forced ones carry an F, constants their mark, changed ones glow for a second. */
export function ValueCell({ runtimeId, row, lost, painter, index = 0, format }: ValueCellProps) {
  const t = useText();
  const item = useLiveItem(runtimeId, row.expression);
  const forced = useForced(runtimeId, row.expression);
  if (isExpandable(row) || item === null) return null;
  if (item.error) return <span className={styles.invalid}>{item.error}</span>;
  if (!isLeaf(valueKind(item))) return <span className={styles.unknown}>…</span>;
  const constant = item.flags?.includes('CONSTANT') === true;
  return (
    <>
      {constant && <i className={styles.constant}>const</i>}
      {forced && (
        <i className={styles.forced} aria-label={t('online.forced')}>
          F
        </i>
      )}
      <LiveText
        runtimeId={runtimeId}
        expression={row.expression}
        painter={painter}
        index={index}
        inset={(constant ? MARK_PX.constant : 0) + (forced ? MARK_PX.forced : 0)}
        forced={forced}
        lost={lost}
        chosen={format}
      />
    </>
  );
}

interface LiveTextProps {
  runtimeId: string | null;
  expression: string;
  painter: ValuePainter | undefined;
  index: number;
  inset: number;
  forced: boolean;
  lost: boolean;
  chosen: NumberFormat | undefined;
}

/** Writes each value into the page or the table's canvas: React draws a cell once, not ten times a second. */
function LiveText({ runtimeId, expression, painter, index, inset, forced, lost, chosen }: LiveTextProps) {
  const t = useText();
  const general = useEditorSettings((settings) => settings.numberFormat);
  const format = chosen ?? general;
  const frame = useRef<HTMLSpanElement>(null);
  const board = channelOf(runtimeId)?.board ?? null;

  useLayoutEffect(() => {
    const shell = frame.current;
    if (shell === null || board === null) return;
    const place = painter === undefined ? inCell(shell) : inCanvas(shell, painter.row(index, inset));
    const read = board.reader(expression);
    const show = () => {
      const live = read();
      const text = live === null || live.value === null ? '…' : textOf(live);
      place.show(text, toneOf(live));
      if (live !== null && !lost) markFresh(place, live.changedAt);
    };
    const textOf = ({ value, item }: LiveValue) =>
      value === null
        ? ''
        : valueKind(item) === 'string'
          ? formatLiteral(value, item)
          : formatShort(value, item, format, 80);
    const toneOf = (live: LiveValue | null): Tone =>
      lost ? 'lost' : forced ? 'forced' : typeof live?.value === 'boolean' ? (live.value ? 'true' : 'false') : 'plain';
    show();
    const stop = board.subscribe(expression, show);
    return () => {
      stop();
      unmarkFresh(place);
      place.remove();
    };
  }, [board, expression, format, lost, forced, painter, index, inset]);

  // All formats are written only for who points at the value.
  const describe = () => {
    const live = board?.get(expression) ?? null;
    if (frame.current === null || live === null || live.value === null) return;
    const all = formatAll(live.value, live.item);
    const lines = all.map(({ format: f, text }) => (all.length > 1 ? `${t(`online.format.${f}`)}: ${text}` : text));
    frame.current.title = [...lines, live.item.type].join('\n');
  };
  return (
    <span ref={frame} className={painter === undefined ? styles.value : styles.painted} onPointerEnter={describe} />
  );
}

/** The text of an element, changed in place. */
function textIn(element: HTMLElement): Text {
  const first = element.firstChild;
  if (first?.nodeType === Node.TEXT_NODE) return first as Text;
  return element.appendChild(element.ownerDocument.createTextNode(''));
}

/** Shows a value in the cell itself. */
function inCell(shell: HTMLElement): ValuePlace {
  const node = textIn(shell);
  return {
    show: (text, tone) => {
      if (node.data !== text) node.data = text;
      if (shell.dataset.tone !== tone) shell.dataset.tone = tone;
    },
    setFresh: (fresh) => {
      if (fresh) shell.dataset.fresh = '';
      else delete shell.dataset.fresh;
    },
    remove: () => undefined,
  };
}

/** Paints a value; its cell holds the text for assistive technology, which sees the canvas as a picture, and is not laid out. */
function inCanvas(shell: HTMLElement, painted: ValuePlace): ValuePlace {
  shell.setAttribute('role', 'img');
  return {
    ...painted,
    show: (text, tone) => {
      labelValue(shell, text);
      painted.show(text, tone);
    },
    remove: () => {
      unlabelValue(shell);
      painted.remove();
    },
  };
}
