/** Data types as text: array bounds, element type, default literals; what the wizards and dialogs need. */
import { ELEMENTARY_TYPES } from '../grammar';
import type { TypeShape } from './initial';

export interface ArrayDimension {
  readonly low: string;
  readonly high: string;
}

export interface ArrayType {
  readonly dimensions: readonly ArrayDimension[];
  readonly element: string;
}

const ARRAY = /^ARRAY\s*\[([^\]]*)\]\s*OF\s+([\s\S]+)$/i;

/** Takes `ARRAY [0..3, 1..2] OF INT` apart; null for any other type. */
export function parseArrayType(type: string): ArrayType | null {
  const match = ARRAY.exec(type.trim());
  if (match === null) return null;
  const dimensions = (match[1] ?? '').split(',').map((part) => {
    const [low = '', high = ''] = part.split('..').map((bound) => bound.trim());
    return { low, high };
  });
  return { dimensions, element: (match[2] ?? '').trim() };
}

export function formatArrayType(array: ArrayType): string {
  const bounds = array.dimensions.map((d) => `${d.low}..${d.high}`).join(', ');
  return `ARRAY [${bounds}] OF ${array.element}`;
}

/** Index texts of all elements in storage order, `0, 1` ...; null when a bound is no number. */
function elementLabels(dimensions: readonly ArrayDimension[]): string[] | null {
  let labels: string[] = [''];
  for (const { low, high } of dimensions) {
    const from = Number(low);
    const to = Number(high);
    if (low === '' || high === '' || !Number.isInteger(from) || !Number.isInteger(to) || to < from) return null;
    const next: string[] = [];
    for (const label of labels) {
      for (let i = from; i <= to && next.length < 4096; i += 1)
        next.push(label === '' ? String(i) : `${label}, ${String(i)}`);
    }
    labels = next;
  }
  return labels;
}

const ELEMENTARY: ReadonlySet<string> = new Set(ELEMENTARY_TYPES);

/** Name of the type without length, bounds or arguments: `STRING(20)` gives STRING. */
export function baseName(type: string): string {
  return (/^[A-Za-z_][\w.]*/.exec(type.trim())?.[0] ?? '').toUpperCase();
}

function isElementary(type: string): boolean {
  return ELEMENTARY.has(baseName(type));
}

/** The value a variable of this type has without an initial value (LDEC-40). */
function defaultLiteral(type: string): string {
  const name = baseName(type);
  if (name === 'BOOL' || name === 'BIT') return 'FALSE';
  if (name === 'REAL' || name === 'LREAL') return '0.0';
  if (name === 'STRING') return "''";
  if (name === 'WSTRING') return '""';
  if (name === 'TIME') return 'T#0ms';
  if (name === 'LTIME') return 'LTIME#0ns';
  if (name === 'DATE' || name === 'LDATE') return `${name}#1970-01-01`;
  if (['TOD', 'TIME_OF_DAY', 'LTOD', 'LTIME_OF_DAY'].includes(name)) return `${name}#00:00:00`;
  if (['DT', 'DATE_AND_TIME', 'LDT', 'LDATE_AND_TIME'].includes(name)) return `${name}#1970-01-01-00:00:00`;
  return '0';
}

export interface DeclaredMember {
  readonly name: string;
  readonly type: string;
  readonly initial: string | null;
}

/** Members of a user-defined type by name, or null when the type is unknown or has none. */
export type MemberSource = (typeName: string) => readonly DeclaredMember[] | null;

/** The tree of components of a type; unknown types and too deep nesting end as leaves. */
export function shapeOf(type: string, members: MemberSource, depth = 0): TypeShape {
  const leaf: TypeShape = { kind: 'leaf', type, default: defaultLiteral(type) };
  if (depth > 8) return leaf;
  const array = parseArrayType(type);
  if (array !== null) {
    const labels = elementLabels(array.dimensions);
    if (labels === null) return leaf;
    return { kind: 'elements', type, labels, element: shapeOf(array.element, members, depth + 1) };
  }
  if (isElementary(type)) return leaf;
  const own = members(baseName(type));
  if (own === null) return leaf;
  return {
    kind: 'members',
    type,
    members: own.map((m) => ({ name: m.name, initial: m.initial, shape: shapeOf(m.type, members, depth + 1) })),
  };
}
