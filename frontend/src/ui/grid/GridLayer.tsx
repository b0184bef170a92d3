import { useLayoutEffect, useState, type ReactNode, type RefObject } from 'react';

/** Where a layer lies over the body of a grid: the rows on screen of one column, in pixels. */
export interface LayerPlace {
  readonly left: number;
  readonly width: number;
  readonly first: number;
  readonly last: number;
  /** Rows of the whole grid. */
  readonly count: number;
  readonly rowHeight: number;
}

export interface Layer {
  /** The column whose cells the layer covers. */
  readonly column: string;
  readonly draw: (place: LayerPlace) => ReactNode;
}

interface GridLayerProps extends Omit<LayerPlace, 'left' | 'width'> {
  head: RefObject<HTMLDivElement | null>;
  /** Number of the column. */
  at: number;
  draw: Layer['draw'];
}

/** Draws a layer over one column; its place follows that of the column's head. */
export function GridLayer({ head, at, draw, ...rows }: GridLayerProps) {
  const [place, setPlace] = useState({ left: 0, width: 0 });
  useLayoutEffect(() => {
    const cells = [...(head.current?.children ?? [])] as HTMLElement[];
    const cell = cells[at];
    if (cell === undefined) return;
    const look = () => {
      const [left, width] = [cell.offsetLeft, cell.offsetWidth];
      setPlace((before) => (before.left === left && before.width === width ? before : { left, width }));
    };
    // A column moves when one before it grows.
    const observer = new ResizeObserver(look);
    cells.forEach((each) => observer.observe(each));
    look();
    return () => observer.disconnect();
  }, [head, at]);
  return draw({ ...place, ...rows });
}
