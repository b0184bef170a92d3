import { useEffect, useState } from 'react';
import type { ViserWindow } from '../../scene/viserWindow';
import { eyeOf, sameEye } from './camera';
import type { Eye } from './projection';

/** Where the camera of a view is, followed picture by picture; null while it is not ready or not seen. */
export function useEye(view: ViserWindow | null, visible: boolean): Eye | null {
  const [eye, setEye] = useState<Eye | null>(null);
  useEffect(() => {
    if (view === null || !visible) return;
    let shown: Eye | null = null;
    let request = 0;
    const look = () => {
      const now = eyeOf(view);
      if (!sameEye(now, shown)) setEye((shown = now));
      request = requestAnimationFrame(look);
    };
    look();
    return () => cancelAnimationFrame(request);
  }, [view, visible]);
  return view === null ? null : eye;
}
