import { memo } from 'react';
import styles from './Cam.module.css';
import type { CamDrawing } from './curves';
import { pathOf, type GraphName, type Range } from './plot';

interface GraphCurvesProps {
  drawing: CamDrawing;
  graph: GraphName;
  /** The segment that is drawn bold. */
  selected: number | null;
  window: Range;
  values: Range;
  /** Pixels of the plot. */
  width: number;
  height: number;
}

/** The curve of a graph by segments. Remembered: the pointer, whose place is shown, moves much more often than the curve. */
export const GraphCurves = memo(function GraphCurves(props: GraphCurvesProps) {
  const { drawing, graph, selected, window, values, width, height } = props;
  return drawing.segments.map((segment, index) => (
    <path
      key={index}
      className={styles.curve}
      data-curve={graph}
      data-selected={selected === index || undefined}
      d={pathOf(segment.x, segment[graph], window, values, width, height)}
    />
  ));
});
