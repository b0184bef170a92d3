import { useEffect, useRef, type RefObject } from 'react';
import type { CellInputHandle } from '@/ui/grid/CellInput';
import { setOpenField } from './prepared';

/** For the field of a value to prepare: Write and Force take what is typed in it. */
export function useOpenField(): RefObject<CellInputHandle | null> {
  const handle = useRef<CellInputHandle | null>(null);
  useEffect(() => {
    setOpenField(() => handle.current?.commit() ?? true);
    return () => setOpenField(null);
  }, []);
  return handle;
}
