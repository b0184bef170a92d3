import { useText } from '@/i18n';
import { StateDrawing } from './StateDrawing';

const STATES = {
  errorstop: { x: 10, y: 14, text: 'axis.state.errorstop', error: true },
  stopping: { x: 185, y: 14, text: 'axis.state.stopping' },
  homing: { x: 360, y: 14, text: 'axis.state.homing' },
  power_off: { x: 10, y: 216, text: 'axis.state.power_off' },
  standstill: { x: 185, y: 150, text: 'axis.state.standstill' },
  discrete_motion: { x: 360, y: 84, text: 'axis.state.discrete_motion' },
  continuous_motion: { x: 360, y: 150, text: 'axis.state.continuous_motion' },
  synchronized_motion: { x: 360, y: 216, text: 'axis.state.synchronized_motion' },
} as const;
const WAYS =
  'M255 50v100M80 50v166M150 32H185M325 160h35M325 157 360 112M325 178 360 226M150 226 190 186M430 120v30M430 186v30M360 40 322 150M325 40 360 96';

/** The state of an axis in words. */
export function StateText({ state }: { state: string | null }) {
  const t = useText();
  if (state === null) return '–';
  return state in STATES ? t(STATES[state as keyof typeof STATES].text) : state;
}

/** The state machine of PLCopen with the present state lit. */
export function StateDiagram({ state }: { state: string | null }) {
  const t = useText();
  const label = t('axis.diagram', { state: state ?? '–' });
  return <StateDrawing places={STATES} ways={WAYS} height={266} label={label} state={state} />;
}
