import { useLiveNumber } from '@/online/useLive';
import styles from './Cam.module.css';
import type { CamDrawing } from './curves';
import { MARGIN_LEFT, acrossOf, downOf, valueOnCurve, type GraphName, type Range } from './plot';
import { followed } from './runningCam';

interface RunMarksProps {
  runtimeId: string;
  /** Paths of the blocks that follow the cam. */
  followers: readonly string[];
  drawing: CamDrawing | null;
  graph: GraphName;
  window: Range;
  values: Range;
  width: number;
  height: number;
}

/** Where the master is in the cam, and the slave on the curve: one line and one dot for each block. */
export function RunMarks({ followers, ...rest }: RunMarksProps) {
  return followers.map((path) => <RunMark key={path} path={path} {...rest} />);
}

function RunMark(props: Omit<RunMarksProps, 'followers'> & { path: string }) {
  const { path, runtimeId, drawing, graph, window, values, width, height } = props;
  const x = useLiveNumber(runtimeId, followed.master(path));
  const y = useLiveNumber(runtimeId, followed.slave(path));
  if (x === null || x < window.min || x > window.max) return null;
  const left = MARGIN_LEFT + acrossOf(x, window, width);
  // The slave is where the application has it; derivatives are those of the curve that is shown.
  const value = graph === 'y' ? y : drawing && valueOnCurve(drawing, graph, x);
  return (
    <g data-run={path}>
      <line className={styles.runLine} x1={left} x2={left} y1={0} y2={height} />
      {value !== null && <circle className={styles.runDot} cx={left} cy={downOf(value, values, height)} r={4.5} />}
    </g>
  );
}

type RunLinesProps = Pick<RunMarksProps, 'runtimeId' | 'followers' | 'window' | 'width' | 'height'>;

/** Where the master is, over a track of tappets. */
export function RunLines({ followers, ...rest }: RunLinesProps) {
  return followers.map((path) => <RunLine key={path} path={path} {...rest} />);
}

function RunLine(props: Omit<RunLinesProps, 'followers'> & { path: string }) {
  const { path, runtimeId, window, width, height } = props;
  const x = useLiveNumber(runtimeId, followed.master(path));
  if (x === null || x < window.min || x > window.max) return null;
  const left = MARGIN_LEFT + acrossOf(x, window, width);
  return (
    <g data-run={path}>
      <line className={styles.runLine} x1={left} x2={left} y1={0} y2={height} />
    </g>
  );
}
