import { useRef, useState, type KeyboardEvent, type PointerEvent, type ReactNode } from 'react';
import { useText } from '@/i18n';
import styles from './Splitter.module.css';

interface SplitterProps {
  top: ReactNode;
  bottom: ReactNode;
  /** Part of the height that the upper pane takes, 0..1. */
  share: number;
  onShare: (share: number) => void;
}

const LEAST_PX = 56;
const KEY_STEP = 0.04;

/** Two panes above each other with a bar between that is dragged or moved by arrow keys; a double click evens out. */
export function Splitter({ top, bottom, share, onShare }: SplitterProps) {
  const t = useText();
  const frame = useRef<HTMLDivElement>(null);
  const [dragged, setDragged] = useState<number | null>(null);
  const now = dragged ?? share;

  const within = (wanted: number) => {
    const height = frame.current?.clientHeight ?? 600;
    const least = Math.min(0.45, LEAST_PX / Math.max(height, 1));
    return Math.max(least, Math.min(1 - least, wanted));
  };
  const onPointerDown = (event: PointerEvent) => {
    event.currentTarget.setPointerCapture(event.pointerId);
    setDragged(share);
  };
  const onPointerMove = (event: PointerEvent) => {
    const box = frame.current?.getBoundingClientRect();
    if (dragged !== null && box !== undefined) setDragged(within((event.clientY - box.top) / box.height));
  };
  const onPointerUp = () => {
    if (dragged !== null) onShare(dragged);
    setDragged(null);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
    event.preventDefault();
    onShare(within(share + (event.key === 'ArrowUp' ? -KEY_STEP : KEY_STEP)));
  };

  return (
    <div ref={frame} className={styles.frame}>
      <div className={styles.pane} style={{ flexBasis: `${String(now * 100)}%` }}>
        {top}
      </div>
      <div
        className={styles.bar}
        role="separator"
        aria-orientation="horizontal"
        aria-label={t('st.splitter')}
        aria-valuenow={Math.round(now * 100)}
        aria-valuemin={0}
        aria-valuemax={100}
        tabIndex={0}
        data-dragged={dragged !== null || undefined}
        onPointerDown={onPointerDown}
        onPointerMove={onPointerMove}
        onPointerUp={onPointerUp}
        onPointerCancel={onPointerUp}
        onDoubleClick={() => onShare(within(0.4))}
        onKeyDown={onKeyDown}
      />
      <div className={styles.pane} style={{ flexBasis: `${String((1 - now) * 100)}%` }}>
        {bottom}
      </div>
    </div>
  );
}
