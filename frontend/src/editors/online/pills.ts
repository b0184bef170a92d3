/** What stands behind a variable in a line: the text and look of its value. Pure. */
import type { LiveValue } from '@/online/board';
import { formatShort } from '@/online/format';
import { FRESH_MS } from '@/online/freshMarks';
import type { NumberFormat } from '@/text/settings';
import { isLeaf, valueKind } from '@/online/item';
import { wholeNumber } from '@/online/literal';

export interface PillState {
  readonly live: LiveValue | null;
  /** Its literal right after the statement of its line; null without flow control, and where that was not executed. */
  readonly executed: string | null;
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
  if (state.executed !== null) return executedPill(state, state.executed, width);
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

/** Values of flow control stand beside those of other lines and other moments: none of them is marked as fresh. */
function executedPill({ live, forced, lost, prepared, format }: PillState, literal: string, width: number): Pill {
  const classes = ['pill', 'executed'];
  const plain = executedText(literal, live, format);
  if (plain === 'TRUE' || plain === 'FALSE') classes.push(plain.toLowerCase());
  if (forced) classes.push('forced');
  if (lost) classes.push('lost');
  const padded = /^[A-Za-z_]/.test(plain) ? plain.padEnd(width, NO_BREAK) : plain.padStart(width, NO_BREAK);
  return {
    text: forced ? `F${NO_BREAK}${padded}` : padded,
    classes,
    prepared: prepared === null ? null : `<${prepared}>`,
  };
}

/** A literal in the number format of the view, where it is a number and the type of its variable is known. */
export function executedText(literal: string, live: LiveValue | null, format: NumberFormat): string {
  const kind = live === null ? null : valueKind(live.item);
  const whole = kind === 'int' || kind === 'uint' || kind === 'bits' ? wholeNumber(literal) : null;
  const real = kind === 'real' ? Number(literal) : NaN;
  if (live !== null && whole !== null) return formatShort(whole, live.item, format, LONGEST);
  if (live !== null && !Number.isNaN(real)) return formatShort(real, live.item, format, LONGEST);
  return literal.length <= LONGEST ? literal : `${literal.slice(0, LONGEST - 1)}\u2026`;
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
    return this.grown(`${format} ${key}`, formatShort(value, live.item, format, LONGEST).length);
  }

  /** Of what flow control shows at a place. */
  widthOfExecuted(place: string, text: string): number {
    return text === 'TRUE' || text === 'FALSE' ? 5 : this.grown(place, text.length);
  }

  private grown(key: string, now: number): number {
    const known = Math.max(this.widths.get(key) ?? 0, now);
    this.widths.set(key, known);
    return known;
  }
}
