import type { Schemas } from '@/api/types';
import { useText, type TextKey } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { Field, TextInput } from '@/ui/Field';
import { LARGEST_PERCENT, LARGEST_RESERVE, leastFault, percentFault, USUAL_RESERVE, type ReserveData } from './reserve';

interface ReserveFieldsProps {
  application: Schemas['ApplicationData'];
  disabled: boolean;
  onChange: (reserve: ReserveData) => void;
}

/** How much memory a download sets aside for online changes. */
export function ReserveFields({ application, disabled, onChange }: ReserveFieldsProps) {
  const t = useText();
  const reserve = application.change_reserve ?? USUAL_RESERVE;
  const field = (name: keyof ReserveData, label: TextKey, hint: TextKey, fault: TextKey | null, most: number) => (
    <Field row label={t(label)} hint={t(hint)} error={fault && t(fault, { most })}>
      {(attributes) => (
        <div className={styles.inline}>
          <TextInput
            {...attributes}
            className={styles.narrow}
            type="number"
            min={0}
            max={most}
            disabled={disabled}
            value={Number.isNaN(reserve[name]) ? '' : reserve[name]}
            onValue={(value) => onChange({ ...reserve, [name]: value === '' ? Number.NaN : Number(value) })}
          />
          {name === 'percent' ? '%' : 'KiB'}
        </div>
      )}
    </Field>
  );
  return (
    <Section title={t('application.reserve')}>
      <div className={styles.fields}>
        {field(
          'percent',
          'application.reservePercent',
          'application.reservePercentHint',
          percentFault(reserve.percent),
          LARGEST_PERCENT,
        )}
        {field(
          'least_kib',
          'application.reserveLeast',
          'application.reserveLeastHint',
          leastFault(reserve.least_kib),
          LARGEST_RESERVE,
        )}
      </div>
    </Section>
  );
}
