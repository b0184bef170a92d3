import { useState, type KeyboardEvent } from 'react';
import { TextInput } from '@/ui/Field';
import styles from './Cam.module.css';

interface CommitInputProps {
  id?: string;
  label?: string;
  value: string;
  disabled?: boolean;
  /** Why a text cannot be taken, or null. */
  check: (text: string) => string | null;
  onCommit: (text: string) => void;
  onFault: (fault: string | null) => void;
  onFocus?: () => void;
}

/** A field whose text counts when it is left or by Enter; one that cannot be taken leaves the old value (CAM-63). */
export function CommitInput({ id, label, value, disabled, check, onCommit, onFault, onFocus }: CommitInputProps) {
  const [typed, setTyped] = useState<string | null>(null);
  const leave = () => {
    if (typed === null) return; // What was said of the last text stays: below a pointer nothing must move
    const fault = typed === value ? null : check(typed);
    onFault(fault);
    if (fault === null && typed !== value) onCommit(typed);
    setTyped(null);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === 'Enter') {
      // A dialog that opens now must not be answered by the same key.
      event.preventDefault();
      leave();
    } else if (event.key === 'Escape' && typed !== null) {
      event.stopPropagation();
      setTyped(null);
      onFault(null);
    }
  };
  return (
    <TextInput
      id={id}
      aria-label={label}
      className={`${styles.commit} code`}
      inputMode="decimal"
      disabled={disabled}
      value={typed ?? value}
      onValue={setTyped}
      onFocus={onFocus}
      onBlur={leave}
      onKeyDown={onKeyDown}
    />
  );
}
