import { useText, type TextKey } from '@/i18n';
import { Facts } from '@/ui/Facts';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import type { AxisSettings } from './model';

const DRIVES = {
  SM_Drive_Virtual: { type: 'AXIS_REF_VIRTUAL_SM3', text: 'axis.info.virtualText' },
  SM_Drive_Simulated: { type: 'AXIS_REF_MAPPING_SM3', text: 'axis.info.simulatedText' },
  SM_Drive_GenericDSP402: { type: 'AXIS_REF_MAPPING_SM3', text: 'axis.info.genericText' },
  SM_Drive_PosControl: { type: 'AXIS_REF_POSCONTROL_SM3', text: 'axis.info.controlText' },
  SM_Drive_Logical: { type: 'AXIS_REF_LOGICAL_SM3', text: 'axis.info.logicalText' },
} as const satisfies Record<AxisSettings['drive'], { type: string; text: TextKey }>;

/** Name, vendor and kind of the device (STA-02). */
export function InformationPage({ name, drive }: { name: string; drive: AxisSettings['drive'] | undefined }) {
  const t = useText();
  const { type, text } = DRIVES[drive ?? 'SM_Drive_Virtual'];
  return (
    <div className={form.page} tabIndex={0}>
      <div className={form.inner}>
        <Section title={t('axis.page.information')}>
          <Facts>
            <dt>{t('axis.info.name')}</dt>
            <dd>{name}</dd>
            <dt>{t('axis.info.device')}</dt>
            <dd>{drive ?? '–'}</dd>
            <dt>{t('axis.info.vendor')}</dt>
            <dd>Tappet</dd>
            <dt>{t('axis.info.categories')}</dt>
            <dd>{t('axis.info.softMotion')}</dd>
            <dt>{t('axis.info.library')}</dt>
            <dd>SM3_Basic</dd>
            <dt>{t('axis.info.variable')}</dt>
            <dd className="code">{`IoConfig_Globals.${name} : ${type}`}</dd>
            <dt>{t('axis.info.description')}</dt>
            <dd>{t(text)}</dd>
          </Facts>
        </Section>
      </div>
    </div>
  );
}
