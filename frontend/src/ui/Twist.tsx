import { ChevronRight } from 'lucide-react';
import type { HTMLAttributes } from 'react';
import styles from './Twist.module.css';

interface TwistProps extends HTMLAttributes<HTMLSpanElement> {
  open: boolean;
  /** Whether there is something below the row; else only its place is kept. */
  expandable: boolean;
}

/** The arrow before the row of a tree that opens and closes it. */
export function Twist({ open, expandable, ...rest }: TwistProps) {
  return (
    <span className={styles.twist} data-open={open ? '' : undefined} {...rest}>
      {expandable && <ChevronRight size={14} strokeWidth={1.75} />}
    </span>
  );
}
