/** What the axes show as long as nobody zooms or scrolls (TRC-50 to TRC-52, TRC-61). Pure functions. */
import type { Range } from '@/editors/plot/scales';
import { signedDuration, timeLiteral } from '@/iec/duration';
import type { TimeAxis, ValueAxis } from '../configuration';
import { withRoom } from './viewport';

const SECOND = 1e9;

/** Times by the rule of the axis; `extent` is what is recorded, `span` what the buffer holds (0: all that is recorded). */
export function timeRange(axis: TimeAxis, extent: Range | null, span: number): Range {
  const end = extent?.max ?? 0;
  if (axis.mode === 'fixed') {
    const [min, max] = [signedDuration(axis.minimum), signedDuration(axis.maximum)];
    if (min !== null && max !== null && min < max) return { min, max };
  }
  if (axis.mode === 'scrolling') {
    const length = timeLiteral(axis.length) ?? 0;
    if (length > 0) return { min: end - length, max: end };
  }
  if (extent === null) return { min: 0, max: span > 0 ? span : SECOND };
  // A ring that is not full yet grows into the time it will hold.
  if (span > 0)
    return extent.max - extent.min < span ? { min: extent.min, max: extent.min + span } : { min: end - span, max: end };
  return extent.max > extent.min ? extent : { min: extent.min - SECOND / 2, max: extent.min + SECOND / 2 };
}

/** Values by the rule of the axis; `seen` is the range of the curves within the time shown. */
export function valueScale(axis: ValueAxis, seen: Range | null): Range {
  if (axis.mode === 'fixed' && axis.minimum < axis.maximum) return { min: axis.minimum, max: axis.maximum };
  if (axis.mode === 'scrolling' && axis.length > 0 && seen !== null)
    return { min: seen.max - axis.length, max: seen.max };
  return withRoom(seen);
}
