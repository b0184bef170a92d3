import { Table2, TextInitial } from 'lucide-react';
import type { ReactNode } from 'react';
import { IconButton } from '@/ui/Button';
import type { TextView } from './settings';
import styles from './ViewSwitch.module.css';

interface ViewSwitchProps {
  /** Names for screen readers and tooltips: of the group and of its two buttons. */
  labels: Readonly<Record<'group' | TextView, string>>;
  view: TextView;
  onView: (view: TextView) => void;
  children: ReactNode;
}

/** A text that is also a table, and the two buttons that change between them (DECL-03). */
export function ViewSwitch({ labels, view, onView, children }: ViewSwitchProps) {
  const button = (one: TextView, icon: typeof Table2) => (
    <IconButton small icon={icon} label={labels[one]} pressed={view === one} onClick={() => onView(one)} />
  );
  return (
    <div className={styles.pane}>
      <div className={styles.view}>{children}</div>
      <div className={styles.switch} role="group" aria-label={labels.group}>
        {button('text', TextInitial)}
        {button('table', Table2)}
      </div>
    </div>
  );
}
