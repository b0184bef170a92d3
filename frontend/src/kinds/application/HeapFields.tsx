import type { Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { Checkbox, Field, TextInput } from '@/ui/Field';
import { LARGEST_HEAP, limitFault, USUAL_HEAP, type HeapData } from './heap';

interface HeapFieldsProps {
  application: Schemas['ApplicationData'];
  disabled: boolean;
  onChange: (heap: HeapData) => void;
}

/** The limit of the memory of __NEW, and whether it is filled when it is given back. */
export function HeapFields({ application, disabled, onChange }: HeapFieldsProps) {
  const t = useText();
  const heap = application.heap ?? USUAL_HEAP;
  const fault = limitFault(heap.limit_kib);
  return (
    <Section title={t('application.heap')}>
      <div className={styles.fields}>
        <Field
          row
          label={t('application.heapLimit')}
          hint={t('application.heapLimitHint')}
          error={fault && t(fault, { most: LARGEST_HEAP })}
        >
          {(attributes) => (
            <div className={styles.inline}>
              <TextInput
                {...attributes}
                className={styles.narrow}
                type="number"
                min={0}
                max={LARGEST_HEAP}
                disabled={disabled}
                value={Number.isNaN(heap.limit_kib) ? '' : heap.limit_kib}
                onValue={(value) => onChange({ ...heap, limit_kib: value === '' ? Number.NaN : Number(value) })}
              />
              KiB
            </div>
          )}
        </Field>
        <Checkbox checked={heap.poison} disabled={disabled} onChecked={(poison) => onChange({ ...heap, poison })}>
          {t('application.heapPoison')}
        </Checkbox>
      </div>
    </Section>
  );
}
