import { useState } from 'react';
import { useText } from '@/i18n';
import { Field, Select, TextInput } from '@/ui/Field';
import styles from '@/editors/form/Form.module.css';
import { intervalFrom, intervalNs, shownInterval, unitOf, type IntervalUnit } from './model';

interface TimeFieldProps {
  label: string;
  value: string;
  error: string | null;
  disabled: boolean;
  onValue: (value: string) => void;
}

/**
 * A time as number and unit (TASK-17), or typed as TIME literal; what was typed becomes its stored form when the field
 * is left. Another unit shows the same time.
 */
export function TimeField({ label, value, error, disabled, onValue }: TimeFieldProps) {
  const t = useText();
  const [typed, setTyped] = useState<string | null>(null);
  const [unit, setUnit] = useState<IntervalUnit>(unitOf(value));
  const faulty = typed !== null && intervalFrom(typed, unit) === null;

  const take = (text: string, as: IntervalUnit) => {
    const stored = intervalFrom(text, as);
    if (stored === null) return;
    setTyped(null);
    if (intervalNs(stored) !== intervalNs(value)) onValue(stored);
  };

  return (
    <Field row label={label} error={faulty ? t('task.timeFault') : error} hint={t('task.timeHint')}>
      {(attributes) => (
        <div className={styles.inline}>
          <TextInput
            {...attributes}
            className={`${styles.narrow} code`}
            disabled={disabled}
            value={typed ?? shownInterval(value, unit)}
            onValue={setTyped}
            onBlur={() => typed !== null && take(typed, unit)}
            onKeyDown={(event) => {
              if (event.key === 'Enter' && typed !== null) take(typed, unit);
              if (event.key === 'Escape') setTyped(null);
            }}
          />
          <Select<IntervalUnit>
            className={styles.unit}
            label={t('task.unit')}
            disabled={disabled}
            value={unit}
            choices={[
              { value: 'ms', text: 'ms' },
              { value: 'us', text: 'µs' },
            ]}
            onValue={setUnit}
          />
        </div>
      )}
    </Field>
  );
}
