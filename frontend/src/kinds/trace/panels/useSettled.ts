import { useEffect, useRef, useState } from 'react';
import type { Range } from '@/editors/plot/scales';

const SETTLE_MS = 200;

/**
 * The range as it was a moment ago: while it is zoomed or scrolled, what is measured of it is asked for a few times
 * a second and not with every picture.
 */
export function useSettled({ min, max }: Range): Range {
  const [settled, setSettled] = useState<Range>({ min, max });
  const latest = useRef(settled);
  const timer = useRef<ReturnType<typeof setTimeout> | null>(null);
  useEffect(() => {
    latest.current = { min, max };
    timer.current ??= setTimeout(() => {
      timer.current = null;
      const { current } = latest;
      setSettled((before) => (before.min === current.min && before.max === current.max ? before : current));
    }, SETTLE_MS);
  }, [min, max]);
  useEffect(
    () => () => {
      if (timer.current !== null) clearTimeout(timer.current);
      timer.current = null;
    },
    [],
  );
  return settled;
}
