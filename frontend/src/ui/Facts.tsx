import type { ReactNode } from 'react';
import styles from './Facts.module.css';

/** Terms with their values in two columns: `dt` and `dd` by turns. */
export function Facts({ children }: { children: ReactNode }) {
  return <dl className={styles.facts}>{children}</dl>;
}
