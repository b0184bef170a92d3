/** What stands behind a variable in a line: the text and look of its value. Pure. */
import type { LiveValue } from '@/online/board';
import { formatShort } from '@/online/format';
import { FRESH_MS } from '@/online/freshMarks';
import type { NumberFormat } from '@/text/settings';
import { isLeaf, valueKind } from '@/online/item';

export interface PillState {
  readonly live: LiveValue | null;
  readonly forced: boolean;
  readonly prepared: string | null;
  /** The connection is lost: the value is the last one known. */
  readonly lost: boolean;
  /** The line is not the one that runs. */
  readonly stale: boolean;
  readonly now: number;
  readonly format: NumberFormat;
}

export interface Pill {
  readonly text: string;
  readonly classes: readonly string[];
  /** Behind the value: what waits to be written. */
  readonly prepared: string | null;
}

const NO_BREAK = '\u00a0';
const LONGEST = 24;

/** Null where the variable has no value of its own to show. */
export function pillOf(state: PillState, width: number): Pill | null {
  const { live, prepared } = state;
  if (live === null || live.value === null || !isLeaf(valueKind(live.item))) return null;
  const plain = formatShort(live.value, live.item, state.format, LONGEST);
  const classes = ['pill'];
  if (typeof live.value === 'boolean') classes.push(live.value ? 'true' : 'false');
  if (state.forced) classes.push('forced');
  if (state.lost) classes.push('lost');
  else if (live.changedAt > 0 && state.now - live.changedAt < FRESH_MS) classes.push('fresh');
  if (state.stale) classes.push('stale');
  // Numbers keep their point in place, words their beginning.
  const room = Math.min(width, LONGEST);
  const word = typeof live.value === 'boolean' || valueKind(live.item) === 'enum';
  const padded = word ? plain.padEnd(room, NO_BREAK) : plain.padStart(room, NO_BREAK);
  return {
    text: state.forced ? `F${NO_BREAK}${padded}` : padded,
    classes,
    prepared: prepared === null ? null : `<${prepared}>`,
  };
}

/**
 * Widths that only grow, so that text behind a value does not dance while digits come and go: numbers get the width
 * of the widest one seen, BOOL that of FALSE.
 */
export class PillWidths {
  private readonly widths = new Map<string, number>();

  widthOf(key: string, live: LiveValue, format: NumberFormat): number {
    const { value } = live;
    if (value === null || typeof value === 'string') return 0;
    if (typeof value === 'boolean') return 5;
    const now = formatShort(value, live.item, format, LONGEST).length;
    const known = Math.max(this.widths.get(`${format} ${key}`) ?? 0, now);
    this.widths.set(`${format} ${key}`, known);
    return known;
  }
}
