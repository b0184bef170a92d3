import { Check, Minus } from 'lucide-react';
import styles from './ChoiceBox.module.css';

export type Checked = 'all' | 'some' | 'none';

/** What `aria-checked` of a row says. */
export const ARIA_CHECKED: Record<Checked, boolean | 'mixed'> = { all: true, some: 'mixed', none: false };

/** The box of a row of a tree: all of it is chosen, some, or nothing. The row itself is what takes the focus. */
export function ChoiceBox({ state, toggle }: { state: Checked; toggle: () => void }) {
  return (
    <span className={styles.box} data-state={state} onClick={toggle} onDoubleClick={(event) => event.stopPropagation()}>
      {state === 'all' && <Check size={12} strokeWidth={3} />}
      {state === 'some' && <Minus size={12} strokeWidth={3} />}
    </span>
  );
}
