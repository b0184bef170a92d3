import { useRef, type PointerEvent } from 'react';
import styles from './Table.module.css';

/** The right edge of a column head: drag to resize. */
export function Grip({ onResize }: { onResize: (width: number) => void }) {
  const start = useRef<{ x: number; width: number } | null>(null);
  const down = (event: PointerEvent<HTMLSpanElement>) => {
    event.stopPropagation();
    event.currentTarget.setPointerCapture(event.pointerId);
    start.current = { x: event.clientX, width: event.currentTarget.parentElement?.offsetWidth ?? 0 };
  };
  const move = (event: PointerEvent) => {
    if (start.current !== null) onResize(start.current.width + event.clientX - start.current.x);
  };
  const up = () => {
    start.current = null;
  };
  return (
    <span
      className={styles.grip}
      aria-hidden
      onClick={(event) => event.stopPropagation()}
      onPointerDown={down}
      onPointerMove={move}
      onPointerUp={up}
    />
  );
}
