import { useState } from 'react';
import { Field, TextInput } from '@/ui/Field';
import styles from './NumberField.module.css';
import { numberText, typedNumber } from './numbers';

interface NumberFieldProps {
  label: string;
  value: number;
  unit?: string;
  hint?: string;
  error?: string | null;
  disabled?: boolean;
  onValue: (value: number) => void;
}

/** A number with its unit; what is typed stays as it was typed until the field is left. */
export function NumberField({ label, value, unit, hint, error, disabled, onValue }: NumberFieldProps) {
  const [typed, setTyped] = useState<string | null>(null);
  return (
    <Field row label={label} hint={hint} error={error}>
      {(attributes) => (
        <div className={styles.number}>
          <NumberInput
            {...attributes}
            typed={typed}
            setTyped={setTyped}
            value={value}
            disabled={disabled}
            onValue={onValue}
          />
          {unit && <span className={styles.unit}>{unit}</span>}
        </div>
      )}
    </Field>
  );
}

interface NumberInputProps {
  id?: string;
  label?: string;
  value: number;
  typed: string | null;
  setTyped: (text: string | null) => void;
  disabled?: boolean;
  onValue: (value: number) => void;
}

function NumberInput({ label, value, typed, setTyped, onValue, ...rest }: NumberInputProps) {
  return (
    <TextInput
      {...rest}
      aria-label={label}
      className={`${styles.input} code`}
      inputMode="decimal"
      value={typed ?? numberText(value)}
      onValue={(text) => {
        setTyped(text);
        onValue(typedNumber(text));
      }}
      onBlur={() => setTyped(null)}
    />
  );
}

interface NumberCellProps {
  label: string;
  value: number;
  invalid?: boolean;
  disabled?: boolean;
  onValue: (value: number) => void;
}

/** A number in a table or a formula, named for screen readers only. */
export function NumberCell({ label, value, invalid, disabled, onValue }: NumberCellProps) {
  const [typed, setTyped] = useState<string | null>(null);
  return (
    <span aria-invalid={invalid} className={styles.cell}>
      <NumberInput
        label={label}
        typed={typed}
        setTyped={setTyped}
        value={value}
        disabled={disabled}
        onValue={onValue}
      />
    </span>
  );
}
