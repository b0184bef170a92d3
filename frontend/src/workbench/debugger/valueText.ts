import type { FrameVariable } from '@/api/types';

/** What a value looks like in a row: its literal, or the parts of a structure or array as an initial value has them. */
export function valueText({ literal, value }: Pick<FrameVariable, 'literal' | 'value'>): string {
  if (literal !== '') return literal;
  return value === null || value === undefined ? '–' : partsText(value);
}

function partsText(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(partsText).join(', ')}]`;
  if (typeof value === 'object' && value !== null) {
    const parts = Object.entries(value).map(([name, part]) => `${name} := ${partsText(part)}`);
    return `(${parts.join(', ')})`;
  }
  if (typeof value === 'boolean') return value ? 'TRUE' : 'FALSE';
  return typeof value === 'string' ? `'${value.replace(/[$']/g, '$$$&')}'` : String(value);
}
