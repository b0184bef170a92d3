import { useText } from '@/i18n';
import { Checkbox } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import styles from './Axis.module.css';
import { numberText } from '@/editors/form/numbers';
import { ChannelSection } from './ChannelSection';
import { axisFaults, type AxisPageProps, COUNT_NAMES, type CountName, hasDrive } from './model';
import { type Scaling, unitsPerIncrement } from './scaling';
import { NumberCell } from '@/editors/form/NumberField';

/** The arithmetic from increments of the encoder to units of the application, and the channels of the drive (devices.md, 14.3). */
export function ScalingPage(page: AxisPageProps) {
  return (
    <>
      <ScalingSection {...page} />
      <ChannelSection {...page} />
    </>
  );
}

function ScalingSection({ axis, disabled, change }: AxisPageProps) {
  const t = useText();
  const { scaling } = axis;
  const faults = axisFaults(axis);
  const set = (changes: Partial<Scaling>) => change({ scaling: { ...scaling, ...changes } });
  const count = (name: CountName) => (
    <NumberCell
      label={t(`axis.scaling.${name}`)}
      value={scaling[name]}
      invalid={faults[name] !== undefined}
      disabled={disabled}
      onValue={(value) => set({ [name]: value })}
    />
  );
  const wrong = [...COUNT_NAMES, 'units' as const].filter((name) => faults[name]);
  const ratio = unitsPerIncrement(scaling);
  return (
    <Section title={t('axis.scalingTitle')}>
      <div className={styles.formula}>
        {count('increments')}
        <span>{t('axis.scaling.increments')}</span>
        <span>⇔</span>
        {count('motor_turns')}
        <span>{t('axis.scaling.motor_turns')}</span>
        {count('gear_motor_turns')}
        <span>{t('axis.scaling.gear_motor_turns')}</span>
        <span>⇔</span>
        {count('gear_output_turns')}
        <span>{t('axis.scaling.gear_output_turns')}</span>
        {count('output_turns')}
        <span>{t('axis.scaling.output_turns')}</span>
        <span>⇔</span>
        <NumberCell
          label={t('axis.scaling.units')}
          value={scaling.units}
          invalid={faults.units !== undefined}
          disabled={disabled}
          onValue={(units) => set({ units })}
        />
        <span>{t('axis.scaling.units')}</span>
      </div>
      <Checkbox checked={scaling.invert} disabled={disabled} onChecked={(invert) => set({ invert })}>
        {t('axis.invert')}
      </Checkbox>
      {wrong.length > 0 ? (
        <ul className={styles.faults} role="alert">
          {wrong.map((name) => (
            <li key={name}>{t('axis.faultAt', { field: t(`axis.scaling.${name}`), fault: t(faults[name]!) })}</li>
          ))}
        </ul>
      ) : (
        <div className={`${styles.result} code`} data-testid="scaling-result">
          <span>
            {`${scaling.invert ? '−' : ''}(${numberText(scaling.motor_turns)} / ${numberText(scaling.increments)}) · ` +
              `(${numberText(scaling.gear_output_turns)} / ${numberText(scaling.gear_motor_turns)}) · ` +
              `(${numberText(scaling.units)} / ${numberText(scaling.output_turns)}) = ${numberText(ratio)} u / inc`}
          </span>
          <span>{`1 u = ${numberText(1 / ratio)} inc`}</span>
          <span>{`1000 inc = ${numberText(1000 * ratio)} u`}</span>
        </div>
      )}
      <p className={form.note}>{t(hasDrive(axis) ? 'axis.scalingDriveText' : 'axis.scalingText')}</p>
    </Section>
  );
}
