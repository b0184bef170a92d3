import { useText } from '@/i18n';
import styles from './Axis.module.css';

const STATES = {
  errorstop: [10, 14],
  stopping: [185, 14],
  homing: [360, 14],
  power_off: [10, 216],
  standstill: [185, 150],
  discrete_motion: [360, 84],
  continuous_motion: [360, 150],
  synchronized_motion: [360, 216],
} as const;
type State = keyof typeof STATES;
const NAMES = Object.keys(STATES) as State[];
const WIDTH = 140;
const HEIGHT = 36;
/** Ways between the states, as the ends of straight lines. */
const WAYS =
  'M255 50v100M80 50v166M150 32H185M325 160h35M325 157 360 112M325 178 360 226M150 226 190 186M430 120v30M430 186v30M360 40 322 150M325 40 360 96';

/** The state machine of PLCopen with the present state lit. */
export function StateDiagram({ state }: { state: string | null }) {
  const t = useText();
  return (
    <svg
      className={styles.diagram}
      viewBox="0 0 510 266"
      role="img"
      aria-label={t('axis.diagram', { state: state ?? '–' })}
      data-state={state}
    >
      <path d={WAYS} />
      {NAMES.map((name) => {
        const [x, y] = STATES[name];
        return (
          <g key={name} data-lit={name === state} data-tone={name === 'errorstop' ? 'error' : undefined}>
            <rect x={x} y={y} width={WIDTH} height={HEIGHT} rx={4} />
            <text x={x + WIDTH / 2} y={y + HEIGHT / 2}>
              {t(`axis.state.${name}`)}
            </text>
          </g>
        );
      })}
    </svg>
  );
}
