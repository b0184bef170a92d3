import type { ReactNode } from 'react';
import styles from './FilterToggle.module.css';

interface FilterToggleProps {
  /** Whether the entries of this kind are shown. */
  shown: boolean;
  onToggle: () => void;
  children: ReactNode;
}

/** Shows or hides one kind of the entries of a list, above it. */
export function FilterToggle({ shown, onToggle, children }: FilterToggleProps) {
  return (
    <button className={styles.toggle} aria-pressed={shown} onClick={onToggle}>
      {children}
    </button>
  );
}
