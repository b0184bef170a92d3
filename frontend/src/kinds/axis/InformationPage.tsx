import { useText } from '@/i18n';
import { Facts } from '@/ui/Facts';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import type { AxisSettings } from './model';

/** Name, vendor and kind of the device (STA-02). */
export function InformationPage({ name, drive }: { name: string; drive: AxisSettings['drive'] | undefined }) {
  const t = useText();
  const simulated = drive === 'SM_Drive_Simulated';
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
            <dd className="code">{`IoConfig_Globals.${name} : ${simulated ? 'AXIS_REF_MAPPING_SM3' : 'AXIS_REF_VIRTUAL_SM3'}`}</dd>
            <dt>{t('axis.info.description')}</dt>
            <dd>{t(simulated ? 'axis.info.simulatedText' : 'axis.info.virtualText')}</dd>
          </Facts>
        </Section>
      </div>
    </div>
  );
}
