import type { ReactNode } from 'react';
import { TextInput } from './Field';
import styles from './Filter.module.css';

interface FilterTogglesProps<Kind extends string> {
  kinds: readonly Kind[];
  hidden: ReadonlySet<Kind>;
  toggle: (kind: Kind) => void;
  children: (kind: Kind) => ReactNode;
}

/** Show or hide the entries of a list by their kind, above it. */
export function FilterToggles<Kind extends string>({ kinds, hidden, toggle, children }: FilterTogglesProps<Kind>) {
  return kinds.map((kind) => (
    <button
      type="button"
      key={kind}
      className={styles.toggle}
      aria-pressed={!hidden.has(kind)}
      onClick={() => toggle(kind)}
    >
      {children(kind)}
    </button>
  ));
}

interface FilterInputProps {
  label: string;
  value: string;
  onValue: (value: string) => void;
  className?: string;
}

/** The text that shown entries hold. Enter does not send the dialog around it. */
export function FilterInput({ label, ...input }: FilterInputProps) {
  return (
    <TextInput
      {...input}
      placeholder={label}
      aria-label={label}
      onKeyDown={(event) => event.key === 'Enter' && event.preventDefault()}
    />
  );
}
