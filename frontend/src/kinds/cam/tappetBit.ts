/** The bit of a track along the master. Pure functions. */
import type { CamTappet } from './camTable';
import type { Range } from './plot';

/** Where the bit is TRUE when the master passes its range once in positive direction, beginning with FALSE (cam EX-06). */
export function onRanges(tappets: readonly CamTappet[], master: Range): [number, number][] {
  const ranges: [number, number][] = [];
  let since: number | null = null;
  const set = (on: boolean, x: number) => {
    if (on && since === null) since = x;
    else if (!on && since !== null) {
      if (x > since) ranges.push([since, x]);
      since = null;
    }
  };
  for (const { x, positive } of tappets) {
    if (positive === 'on') set(true, x);
    else if (positive === 'off') set(false, x);
    else if (positive === 'invert') set(since === null, x);
  }
  set(false, master.max);
  return ranges;
}
