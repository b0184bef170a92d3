import type { TappetAction } from './camTable';
import styles from './Cam.module.css';

export type SignSide = 'positive' | 'negative';

interface TappetSignProps {
  x: number;
  y: number;
  positive: TappetAction;
  negative: TappetAction;
  selected?: boolean;
}

/**
 * The cross of a tappet: its left end shows what a pass in positive direction does, which comes from there, its right end what one in
 * negative direction does (CAM-54). Up: on, down: off, a rhomb: invert, a short bar: nothing.
 */
export function TappetSign({ x, y, positive, negative, selected }: TappetSignProps) {
  return (
    <g
      className={styles.tappet}
      transform={`translate(${String(x)} ${String(y)})`}
      data-selected={selected || undefined}
      data-positive={positive}
      data-negative={negative}
    >
      <path d="M0 -13V13M-12 0H12" />
      <circle r={selected ? 4.5 : 3} />
      <End side={-1} action={positive} />
      <End side={1} action={negative} />
    </g>
  );
}

const SHAPES: Readonly<Record<TappetAction, string>> = {
  none: 'M0 -4V4',
  on: 'M-5 3H5L0 -6Z',
  off: 'M-5 -3H5L0 6Z',
  invert: 'M-5 0L0 -5L5 0L0 5Z',
};

function End({ side, action }: { side: 1 | -1; action: TappetAction }) {
  return (
    <path
      className={styles.end}
      data-action={action}
      transform={`translate(${String(side * 14)} 0)`}
      d={SHAPES[action]}
    />
  );
}
