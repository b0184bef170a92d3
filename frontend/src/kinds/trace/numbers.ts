/** A value as it stands beside a curve: seven digits, exponents where it is very large or small. */
export function formatNumber(value: number, digits = 7): string {
  if (!Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e9 || size < 1e-4))
    return value
      .toExponential(4)
      .replace(/\.?0+e/, 'e')
      .replace('e+', 'e');
  return String(Number(value.toPrecision(digits)));
}

/** A number of bytes in the unit that fits: `640 KiB`, `21 MiB`, `20 GiB`. */
export function formatBytes(bytes: number): string {
  const units = ['B', 'KiB', 'MiB', 'GiB', 'TiB'];
  let [size, unit] = [bytes, 0];
  while (size >= 1024 && unit < units.length - 1) [size, unit] = [size / 1024, unit + 1];
  return `${unit > 0 && size < 10 ? Number(size.toFixed(1)) : Math.round(size)} ${units[unit]!}`;
}
