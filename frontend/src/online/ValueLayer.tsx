import { useEffect, useLayoutEffect, useRef } from 'react';
import type { LayerPlace } from '@/ui/grid/GridLayer';
import styles from './OnlineTable.module.css';
import type { ValuePainter } from './valuePainter';

/** Rows are covered in blocks, so that scrolling by a row moves no canvas. */
const BLOCK = 16;

/** The canvas over the values of a table. */
export function ValueLayer({ painter, place }: { painter: ValuePainter; place: LayerPlace }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const { left, width, rowHeight } = place;
  const first = Math.floor(place.first / BLOCK) * BLOCK;
  const count = Math.min(place.count, Math.ceil((place.last + 1) / BLOCK) * BLOCK) - first;

  useLayoutEffect(() => {
    const shown = canvas.current;
    if (shown === null) return;
    const cover = () => painter.cover(shown, { first, count, rowHeight, width });
    cover();
    // Another zoom is another number of device pixels.
    const view = shown.ownerDocument.defaultView;
    view?.addEventListener('resize', cover);
    return () => view?.removeEventListener('resize', cover);
  }, [painter, first, count, rowHeight, width]);

  useEffect(() => {
    const page = canvas.current?.ownerDocument;
    if (page === undefined) return;
    const restyle = () => painter.restyle();
    const observer = new MutationObserver(restyle);
    observer.observe(page.documentElement, { attributes: true, attributeFilter: ['data-theme'] });
    page.fonts?.addEventListener('loadingdone', restyle);
    return () => {
      observer.disconnect();
      page.fonts?.removeEventListener('loadingdone', restyle);
    };
  }, [painter]);

  return (
    <canvas
      ref={canvas}
      className={styles.layer}
      aria-hidden
      style={{ left, top: first * rowHeight, width, height: Math.max(0, count) * rowHeight }}
    />
  );
}
