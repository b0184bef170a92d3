import { useState } from 'react';
import { numberText, typedNumber } from '@/editors/form/numbers';
import { Field } from '@/ui/Field';
import styles from './Cam.module.css';
import { CommitInput } from './CommitInput';

interface CommitFieldProps {
  label: string;
  hint?: string;
  unit?: string;
  value: number;
  disabled?: boolean;
  /** Why a number cannot be taken, or null; NaN is what is none. */
  check: (value: number) => string | null;
  onValue: (value: number) => void;
}

/** A labelled number that counts when its field is left. */
export function CommitField({ label, hint, unit, value, disabled, check, onValue }: CommitFieldProps) {
  const [fault, setFault] = useState<string | null>(null);
  return (
    <Field row label={label} hint={hint} error={fault}>
      {(attributes) => (
        <div className={styles.number}>
          <CommitInput
            {...attributes}
            value={numberText(value)}
            disabled={disabled}
            check={(text) => check(typedNumber(text))}
            onFault={setFault}
            onCommit={(text) => onValue(typedNumber(text))}
          />
          {unit && <span className={styles.unit}>{unit}</span>}
        </div>
      )}
    </Field>
  );
}
