/** Numbers as people read and type them. Pure functions. */

/** A number as people write it: up to ten digits, without an end of zeros. */
export function numberText(value: number): string {
  if (!Number.isFinite(value)) return '';
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e10 || size < 1e-6)) return value.toExponential(6).replace(/\.?0+e/, 'e');
  return String(Number(value.toPrecision(10)));
}

/** The number that was typed; NaN where it is none. A comma is taken as point. */
export function typedNumber(text: string): number {
  const plain = text.trim().replace(',', '.');
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : Number.NaN;
}
