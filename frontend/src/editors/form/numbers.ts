/** Numbers as people read and type them. Pure functions. */

/** A number as people write it: up to ten digits, without an end of zeros. */
export function numberText(value: number): string {
  if (!Number.isFinite(value)) return '';
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e10 || size < 1e-6)) return value.toExponential(6).replace(/\.?0+e/, 'e');
  return String(Number(value.toPrecision(10)));
}

/** A number that fits into a narrow column: as `numberText`, with as few digits as that takes. */
export function shortNumber(value: number, length = 10): string {
  const whole = numberText(value);
  if (whole.length <= length) return whole;
  for (let digits = length; digits > 0; digits--) {
    const plain = String(Number(value.toPrecision(digits)));
    const found = plain.length <= length ? plain : value.toExponential(digits - 1).replace('e+', 'e');
    if (found.length <= length) return found;
  }
  return whole;
}

/** The number that was typed; NaN where it is none. A comma is taken as point. */
export function typedNumber(text: string): number {
  const plain = text.trim().replace(',', '.');
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : Number.NaN;
}
