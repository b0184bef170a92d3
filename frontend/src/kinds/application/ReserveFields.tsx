import type { Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { LARGEST_PERCENT, LARGEST_RESERVE, leastFault, percentFault, USUAL_RESERVE, type ReserveData } from './reserve';
import { SizeField } from './SizeField';

interface ReserveFieldsProps {
  application: Schemas['ApplicationData'];
  disabled: boolean;
  onChange: (reserve: ReserveData) => void;
}

/** How much memory a download sets aside for online changes. */
export function ReserveFields({ application, disabled, onChange }: ReserveFieldsProps) {
  const t = useText();
  const reserve = application.change_reserve ?? USUAL_RESERVE;
  const percentWrong = percentFault(reserve.percent);
  const leastWrong = leastFault(reserve.least_kib);
  return (
    <Section title={t('application.reserve')}>
      <div className={styles.fields}>
        <SizeField
          label={t('application.reservePercent')}
          hint={t('application.reservePercentHint')}
          fault={percentWrong && t(percentWrong, { most: LARGEST_PERCENT })}
          unit="%"
          most={LARGEST_PERCENT}
          value={reserve.percent}
          disabled={disabled}
          onValue={(percent) => onChange({ ...reserve, percent })}
        />
        <SizeField
          label={t('application.reserveLeast')}
          hint={t('application.reserveLeastHint')}
          fault={leastWrong && t(leastWrong, { most: LARGEST_RESERVE })}
          unit="KiB"
          most={LARGEST_RESERVE}
          value={reserve.least_kib}
          disabled={disabled}
          onValue={(least_kib) => onChange({ ...reserve, least_kib })}
        />
      </div>
    </Section>
  );
}
