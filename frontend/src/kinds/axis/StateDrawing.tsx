import type { TextKey } from '@/i18n';
import { useText } from '@/i18n';
import styles from './Axis.module.css';

export interface StatePlace {
  x: number;
  y: number;
  text: TextKey;
  error?: boolean;
}

interface StateDrawingProps<State extends string> {
  places: Readonly<Record<State, StatePlace>>;
  /** Ways between the states, as the ends of straight lines. */
  ways: string;
  height: number;
  label: string;
  /** The present one. */
  state: string | null;
}

const WIDTH = 140;
const HEIGHT = 36;

/** A state machine with the present state lit. */
export function StateDrawing<State extends string>({ places, ways, height, label, state }: StateDrawingProps<State>) {
  const t = useText();
  return (
    <svg className={styles.diagram} viewBox={`0 0 510 ${height}`} role="img" aria-label={label} data-state={state}>
      <path d={ways} />
      {(Object.keys(places) as State[]).map((name) => {
        const { x, y, text, error } = places[name];
        return (
          <g key={name} data-lit={name === state} data-tone={error ? 'error' : undefined}>
            <rect x={x} y={y} width={WIDTH} height={HEIGHT} rx={4} />
            <text x={x + WIDTH / 2} y={y + HEIGHT / 2}>
              {t(text)}
            </text>
          </g>
        );
      })}
    </svg>
  );
}
