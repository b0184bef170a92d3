import { useText } from '@/i18n';
import { Field, Select } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { NumberField } from '@/editors/form/NumberField';
import { axisFaults, type AxisPageProps, type AxisSettings, type FieldName } from './model';

type PositionControl = AxisSettings['position_control'];
const BITS = ['16', '24', '32'] as const;

/** The position loop over a drive that follows a speed alone (devices.md, 14.5). */
export function PositionControlPage({ axis, disabled, change }: AxisPageProps) {
  const t = useText();
  const control = axis.position_control;
  const faults = axisFaults(axis);
  const fault = (field: FieldName) => (faults[field] ? t(faults[field]) : null);
  const set = (changes: Partial<PositionControl>) => change({ position_control: { ...control, ...changes } });
  return (
    <>
      <Section title={t('axis.control.loop')}>
        <p className={form.note}>{t('axis.control.loopText')}</p>
        <div className={form.fields}>
          <NumberField
            label={t('axis.control.gain')}
            hint={t('axis.control.gainHint')}
            unit="1/s"
            value={control.gain}
            error={fault('control.gain')}
            disabled={disabled}
            onValue={(gain) => set({ gain })}
          />
          <NumberField
            label={t('axis.deadTime')}
            hint={t('axis.control.deadTimeHint')}
            unit={t('axis.cycles')}
            value={control.dead_time}
            error={fault('control.dead_time')}
            disabled={disabled}
            onValue={(dead_time) => set({ dead_time })}
          />
          <Field row label={t('axis.control.speedFrom')}>
            {(attributes) => (
              <Select<PositionControl['speed_from']>
                {...attributes}
                disabled={disabled}
                value={control.speed_from}
                choices={[
                  { value: 'velocity', text: t('axis.control.fromVelocity') },
                  { value: 'position', text: t('axis.control.fromPosition') },
                ]}
                onValue={(speed_from) => set({ speed_from })}
              />
            )}
          </Field>
        </div>
      </Section>
      <Section title={t('axis.control.drive')}>
        <p className={form.note}>{t('axis.control.driveText')}</p>
        <div className={form.fields}>
          <NumberField
            label={t('axis.control.ratedVelocity')}
            unit="u/s"
            value={control.rated_velocity}
            error={fault('control.rated_velocity')}
            disabled={disabled}
            onValue={(rated_velocity) => set({ rated_velocity })}
          />
          <NumberField
            label={t('axis.control.ratedRaw')}
            hint={t('axis.control.ratedRawHint')}
            value={control.rated_raw}
            error={fault('control.rated_raw')}
            disabled={disabled}
            onValue={(rated_raw) => set({ rated_raw })}
          />
          <Field row label={t('axis.control.bits')} hint={t('axis.control.bitsHint')}>
            {(attributes) => (
              <Select<(typeof BITS)[number]>
                {...attributes}
                disabled={disabled}
                value={BITS.find((bits) => Number(bits) === control.bits) ?? '32'}
                choices={BITS.map((bits) => ({ value: bits, text: t('axis.control.width', { bits }) }))}
                onValue={(bits) => set({ bits: Number(bits) as PositionControl['bits'] })}
              />
            )}
          </Field>
        </div>
      </Section>
    </>
  );
}
