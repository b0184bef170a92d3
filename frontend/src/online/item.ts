/** What the server says about one subscribed expression, and what kind of value its bytes hold. */

import type { ImagePlace } from '@/api/types';

/** An entry of the server's `subscribed` answer. */
export interface SubscribedItem {
  readonly expression: string;
  /** Byte offset in the values part of each frame. */
  readonly offset: number;
  readonly size: number;
  readonly type: string;
  readonly kind: string;
  readonly enum?: Readonly<Record<string, number>>;
  readonly bit?: number | null;
  readonly error?: string | null;
  /** Of CONSTANT, RETAIN, PERSISTENT, DISPLAY_HEX, DISPLAY_BIN, DISPLAY_DEC. */
  readonly flags?: readonly string[];
  readonly section?: string;
  /** Integer kind below an enumeration. */
  readonly base?: string;
  /** Where the variable lies in the controller's memory. */
  readonly place?: ImagePlace | null;
}

/** Whether two places share memory: the same variable under two names, or a part of it. */
export function overlaps(a: ImagePlace, b: ImagePlace): boolean {
  if (a.offset >= b.offset + b.size || b.offset >= a.offset + a.size) return false;
  return a.bit == null || b.bit == null || a.bit === b.bit;
}

/** Whether two answers say the same about an expression; where its bytes stand in a frame does not count. */
export function sameItem(a: SubscribedItem, b: SubscribedItem): boolean {
  return description(a) === description(b);
}

const descriptions = new WeakMap<SubscribedItem, string>();

function description(item: SubscribedItem): string {
  let text = descriptions.get(item);
  if (text === undefined) {
    text = JSON.stringify({ ...item, offset: 0 });
    descriptions.set(item, text);
  }
  return text;
}

export type ValueKind =
  | 'bool'
  | 'int'
  | 'uint'
  | 'bits'
  | 'real'
  | 'time' // u32 ms
  | 'ltime' // u64 ns
  | 'date' // u32 s
  | 'tod' // u32 ms
  | 'dt' // u32 s
  | 'ldate' // u64 ns
  | 'ltod' // u64 ns
  | 'ldt' // u64 ns
  | 'enum'
  | 'string'
  | 'wstring'
  | 'pointer'
  | 'compound' // array, structure, instance: shown by its components
  | 'error';

const DATES: Readonly<Record<string, ValueKind>> = {
  DATE: 'date',
  TIME_OF_DAY: 'tod',
  TOD: 'tod',
  DATE_AND_TIME: 'dt',
  DT: 'dt',
  LDATE: 'ldate',
  LTIME_OF_DAY: 'ltod',
  LTOD: 'ltod',
  LDATE_AND_TIME: 'ldt',
  LDT: 'ldt',
};

const DIRECT = new Set<string>([
  'bool', 'int', 'uint', 'bits', 'real', 'ltime', 'tod', 'dt', 'ldate', 'ltod', 'ldt', 'enum', 'string', 'wstring',
]); // prettier-ignore

/** The kind by which bytes are read, from the server's kind and, where that is a family, type and size. */
export function valueKind(item: Pick<SubscribedItem, 'kind' | 'type' | 'size' | 'error' | 'bit'>): ValueKind {
  if (item.error != null && item.error !== '') return 'error';
  if (item.bit != null) return 'bool';
  if (item.kind === 'time') return item.size === 8 ? 'ltime' : 'time';
  if (item.kind === 'date') return DATES[item.type.toUpperCase()] ?? (item.size === 8 ? 'ldate' : 'date');
  if (DIRECT.has(item.kind)) return item.kind as ValueKind;
  if (['pointer', 'reference', 'interface'].includes(item.kind)) return 'pointer';
  if (item.kind === 'error') return 'error';
  return 'compound';
}

/** Whether a value of this kind can be shown, prepared, written and forced by itself. */
export function isLeaf(kind: ValueKind): boolean {
  return kind !== 'compound' && kind !== 'error';
}

/** bool, number (up to 32 bit and floats), bigint (64 bit), string. */
export type PlcValue = boolean | number | bigint | string;

/** One spelling for each expression, so that two views of a variable share its value. */
export function expressionKey(expression: string): string {
  return expression.replace(/\s+/g, '').toUpperCase();
}
