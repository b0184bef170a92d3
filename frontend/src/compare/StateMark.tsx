import { CircleMinus, CirclePlus, Diff } from 'lucide-react';
import { useText } from '@/i18n';
import type { State } from './comparison';
import styles from './compare.module.css';

const ICONS = { added: CirclePlus, removed: CircleMinus, changed: Diff };

/** What became of an object: picture, colour and word. */
export function StateMark({ state, count }: { state: State; count?: number }) {
  const t = useText();
  const Icon = ICONS[state];
  return (
    <span className={styles.state} data-state={state}>
      <Icon size={14} strokeWidth={2} aria-hidden />
      {t(`compare.state.${state}`)}
      {count !== undefined && <b className="digits">{count}</b>}
    </span>
  );
}
