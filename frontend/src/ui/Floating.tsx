import { useLayoutEffect, useRef, useState, type ReactNode, type Ref } from 'react';
import { createPortal } from 'react-dom';
import styles from './Floating.module.css';

interface FloatingProps {
  /** Element it hangs on. */
  anchor: HTMLElement | null;
  /** `over` covers the anchor and grows from there; `below` hangs under it, or above where there is no room. */
  place?: 'below' | 'over';
  className?: string;
  ref?: Ref<HTMLDivElement>;
  children: ReactNode;
}

const GAP = 3;
const MARGIN = 6;

/** A small thing that hangs on a cell but is cut off by no pane. */
export function Floating({ anchor, place = 'below', className, ref, children }: FloatingProps) {
  const box = useRef<HTMLDivElement>(null);
  const [at, setAt] = useState<{ left: number; top: number; minWidth: number } | null>(null);

  useLayoutEffect(() => {
    const follow = () => {
      if (anchor === null || box.current === null) return;
      const cell = anchor.getBoundingClientRect();
      const own = box.current.getBoundingClientRect();
      const under = place === 'over' ? cell.top - 1 : cell.bottom + GAP;
      const above = place === 'over' ? cell.bottom - own.height + 1 : cell.top - own.height - GAP;
      const top = under + own.height > innerHeight - MARGIN && above > MARGIN ? above : under;
      const left = Math.max(MARGIN, Math.min(cell.left - 1, innerWidth - own.width - MARGIN));
      setAt((before) =>
        before?.left === left && before.top === top ? before : { left, top, minWidth: cell.width + 2 },
      );
    };
    follow();
    const sizes = new ResizeObserver(follow);
    if (box.current !== null) sizes.observe(box.current);
    addEventListener('scroll', follow, true);
    addEventListener('resize', follow);
    return () => {
      sizes.disconnect();
      removeEventListener('scroll', follow, true);
      removeEventListener('resize', follow);
    };
  }, [anchor, place]);

  const stop = (event: { stopPropagation: () => void }) => event.stopPropagation();
  return createPortal(
    <div
      ref={(element) => {
        box.current = element;
        if (typeof ref === 'function') ref(element);
        else if (ref) ref.current = element;
      }}
      className={`${styles.floating} ${className ?? ''}`}
      style={at ?? { left: 0, top: 0, opacity: 0 }}
      onPointerDown={stop}
      onDoubleClick={stop}
      onContextMenu={stop}
    >
      {children}
    </div>,
    document.body,
  );
}
