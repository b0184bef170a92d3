import { Field, TextInput } from '@/ui/Field';
import styles from '@/editors/form/Form.module.css';

interface SizeFieldProps {
  label: string;
  hint: string;
  fault: string | null;
  unit: string;
  most: number;
  /** NaN while nothing is typed. */
  value: number;
  disabled: boolean;
  onValue: (value: number) => void;
}

/** A whole number from 0 on with its unit. */
export function SizeField({ label, hint, fault, unit, most, value, disabled, onValue }: SizeFieldProps) {
  return (
    <Field row label={label} hint={hint} error={fault}>
      {(attributes) => (
        <div className={styles.inline}>
          <TextInput
            {...attributes}
            className={styles.narrow}
            type="number"
            min={0}
            max={most}
            disabled={disabled}
            value={Number.isNaN(value) ? '' : value}
            onValue={(text) => onValue(text === '' ? Number.NaN : Number(text))}
          />
          {unit}
        </div>
      )}
    </Field>
  );
}
