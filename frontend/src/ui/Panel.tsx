import type { HTMLAttributes, ReactNode, Ref } from 'react';
import styles from './Panel.module.css';

/** The column of a tool window. */
export function Panel({ children }: { children: ReactNode }) {
  return <div className={styles.panel}>{children}</div>;
}

/** The line at its top: what is looked for, which kinds are shown. */
export function PanelBar({ children }: { children: ReactNode }) {
  return <div className={styles.bar}>{children}</div>;
}

/** What takes the height that is left. */
export function PanelRest(props: HTMLAttributes<HTMLDivElement> & { ref?: Ref<HTMLDivElement> }) {
  return <div {...props} className={styles.rest} />;
}
