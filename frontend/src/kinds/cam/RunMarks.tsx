import { useLiveNumber } from '@/online/useLive';
import styles from './Cam.module.css';
import { MARGIN_LEFT, acrossOf, type Range } from './plot';
import { followed } from './runningCam';

interface RunMarksProps {
  runtimeId: string;
  /** Paths of the blocks that follow the cam. */
  followers: readonly string[];
  window: Range;
  width: number;
  height: number;
  /** How far down the slave is where the master is, by positions of both; null: nowhere. */
  down?: (x: number, y: number | null) => number | null;
}

/** Where masters are in the cam: a line for each block that follows it, with a dot for its slave. */
export function RunMarks({ followers, ...rest }: RunMarksProps) {
  return followers.map((path) => <RunMark key={path} path={path} {...rest} />);
}

function RunMark({
  path,
  runtimeId,
  window,
  width,
  height,
  down,
}: Omit<RunMarksProps, 'followers'> & { path: string }) {
  const x = useLiveNumber(runtimeId, followed.master(path));
  const y = useLiveNumber(runtimeId, followed.slave(path));
  if (x === null || x < window.min || x > window.max) return null;
  const left = MARGIN_LEFT + acrossOf(x, window, width);
  const top = down?.(x, y) ?? null;
  return (
    <g data-run={path}>
      <line className={styles.runLine} x1={left} x2={left} y1={0} y2={height} />
      {top !== null && <circle className={styles.runDot} cx={left} cy={top} r={4.5} />}
    </g>
  );
}
