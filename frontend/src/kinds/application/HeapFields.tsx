import type { Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { Checkbox } from '@/ui/Field';
import { LARGEST_HEAP, limitFault, USUAL_HEAP, type HeapData } from './heap';
import { SizeField } from './SizeField';

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
        <SizeField
          label={t('application.heapLimit')}
          hint={t('application.heapLimitHint')}
          fault={fault && t(fault, { most: LARGEST_HEAP })}
          unit="KiB"
          most={LARGEST_HEAP}
          value={heap.limit_kib}
          disabled={disabled}
          onValue={(limit_kib) => onChange({ ...heap, limit_kib })}
        />
        <Checkbox checked={heap.poison} disabled={disabled} onChecked={(poison) => onChange({ ...heap, poison })}>
          {t('application.heapPoison')}
        </Checkbox>
      </div>
    </Section>
  );
}
