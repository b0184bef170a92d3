import { memo, useEffect, useLayoutEffect, useRef } from 'react';
import type { LayerPlace } from '@/ui/grid/GridLayer';
import styles from './OnlineTable.module.css';
import type { ValuePainter } from './valuePainter';

/** Rows of a canvas. None moves or is painted again when the table scrolls: further ones come and go. */
const ROWS = 64;

/** The canvases over the values of a table. */
export function ValueLayer({ painter, place }: { painter: ValuePainter; place: LayerPlace }) {
  const layer = useRef<HTMLDivElement>(null);
  const firstBlock = Math.floor(place.first / ROWS);
  const blocks = place.count === 0 ? 0 : Math.floor(place.last / ROWS) + 1 - firstBlock;

  useEffect(() => {
    const page = layer.current?.ownerDocument;
    if (page === undefined) return;
    const restyle = () => painter.restyle();
    const observer = new MutationObserver(restyle);
    observer.observe(page.documentElement, { attributes: true, attributeFilter: ['data-theme'] });
    page.fonts?.addEventListener('loadingdone', restyle);
    const forcedColors = page.defaultView?.matchMedia('(forced-colors: active)');
    forcedColors?.addEventListener('change', restyle);
    return () => {
      observer.disconnect();
      forcedColors?.removeEventListener('change', restyle);
      page.fonts?.removeEventListener('loadingdone', restyle);
    };
  }, [painter]);

  return (
    <div ref={layer} aria-hidden>
      {Array.from({ length: blocks }, (_, at) => (
        <ValueCanvas
          key={firstBlock + at}
          painter={painter}
          first={(firstBlock + at) * ROWS}
          count={Math.min(ROWS, place.count - (firstBlock + at) * ROWS)}
          left={place.left}
          width={place.width}
          rowHeight={place.rowHeight}
        />
      ))}
    </div>
  );
}

interface ValueCanvasProps extends Omit<LayerPlace, 'last'> {
  painter: ValuePainter;
}

const ValueCanvas = memo(function ValueCanvas({ painter, first, count, left, width, rowHeight }: ValueCanvasProps) {
  const canvas = useRef<HTMLCanvasElement>(null);

  useLayoutEffect(() => {
    const shown = canvas.current;
    if (shown === null) return;
    const cover = () => painter.cover(shown, { first, count, rowHeight, left, width });
    cover();
    // Another zoom is another number of device pixels.
    const view = shown.ownerDocument.defaultView;
    view?.addEventListener('resize', cover);
    return () => view?.removeEventListener('resize', cover);
  }, [painter, first, count, rowHeight, left, width]);

  useLayoutEffect(() => {
    const shown = canvas.current;
    return () => {
      if (shown !== null) painter.uncover(shown);
    };
  }, [painter]);

  return <canvas ref={canvas} className={styles.layer} />;
});
