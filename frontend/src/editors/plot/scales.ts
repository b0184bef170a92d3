/** Scales of plots: ranges, ticks and places in pixels. Pure functions. */

export interface Range {
  min: number;
  max: number;
}

/** The step of a scale: 1, 2 or 5 times a power of ten, so that about `count` of them fill the range. */
export function niceStep(range: Range, count: number): number {
  const rough = (range.max - range.min) / Math.max(1, count);
  if (!(rough > 0) || !Number.isFinite(rough)) return 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const part = rough / power;
  return (part <= 1 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10) * power;
}

/** The multiples of the step within a range. */
export function ticks(range: Range, count: number): number[] {
  const step = niceStep(range, count);
  const first = Math.ceil(range.min / step - 1e-9);
  const last = Math.floor(range.max / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, at) => clean((first + at) * step, step));
}

/** A tick with as many decimals as its step needs. */
export function tickText(value: number, step: number): string {
  if (value === 0) return '0';
  const size = Math.max(Math.abs(value), step);
  if (size >= 1e6 || step < 1e-5) return value.toExponential(2).replace(/\.?0+e/, 'e');
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

/** A multiple of `step` without the rest that binary fractions leave. */
export function clean(value: number, step: number): number {
  const decimals = Math.max(0, Math.min(15, 2 - Math.floor(Math.log10(step))));
  return Number(value.toFixed(decimals)) + 0;
}

/** Pixels between the left edge of a plot and a place. */
export function acrossOf(x: number, window: Range, width: number): number {
  return ((x - window.min) / (window.max - window.min)) * width;
}

/** Pixels between the upper edge of a plot and a value. */
export function downOf(value: number, values: Range, height: number): number {
  return ((values.max - value) / (values.max - values.min)) * height;
}

/** A curve as the path of an SVG; `left` is where the plot begins. */
export function curvePath(
  xs: readonly number[],
  curve: readonly number[],
  window: Range,
  values: Range,
  size: { left: number; width: number; height: number },
): string {
  return xs
    .map((x, at) => {
      const across = size.left + acrossOf(x, window, size.width);
      return `${at === 0 ? 'M' : 'L'}${across.toFixed(2)} ${downOf(curve[at]!, values, size.height).toFixed(2)}`;
    })
    .join('');
}
