import { useText } from '@/i18n';
import { Checkbox, Field, Select } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { NumberField } from '@/editors/form/NumberField';
import { axisFaults, type AxisPageProps, type AxisSettings, type FieldName } from './model';

type GenericDrive = AxisSettings['generic_drive'];
const BITS = ['16', '24', '32'] as const;

/** What an axis has to know of a drive that speaks CiA 402. */
export function GenericDrivePage({ axis, disabled, change }: AxisPageProps) {
  const t = useText();
  const drive = axis.generic_drive;
  const faults = axisFaults(axis);
  const fault = (field: FieldName) => (faults[field] ? t(faults[field]) : null);
  const set = (changes: Partial<GenericDrive>) => change({ generic_drive: { ...drive, ...changes } });
  return (
    <Section title={t('axis.page.drive')}>
      <p className={form.note}>{t('axis.generic.text')}</p>
      <div className={form.fields}>
        <NumberField
          label={t('axis.drive.limits.rated_torque')}
          hint={t('axis.generic.ratedTorqueHint')}
          unit="Nm"
          value={drive.rated_torque}
          error={fault('generic.rated_torque')}
          disabled={disabled}
          onValue={(rated_torque) => set({ rated_torque })}
        />
        <NumberField
          label={t('axis.deadTime')}
          hint={t('axis.generic.deadTimeHint')}
          unit={t('axis.cycles')}
          value={drive.dead_time}
          error={fault('generic.dead_time')}
          disabled={disabled}
          onValue={(dead_time) => set({ dead_time })}
        />
        <Field row label={t('axis.generic.bits')}>
          {(attributes) => (
            <Select<(typeof BITS)[number]>
              {...attributes}
              disabled={disabled}
              value={BITS.find((bits) => Number(bits) === drive.bits) ?? '32'}
              choices={BITS.map((bits) => ({ value: bits, text: t('axis.control.width', { bits }) }))}
              onValue={(bits) => set({ bits: Number(bits) as GenericDrive['bits'] })}
            />
          )}
        </Field>
        <Checkbox
          checked={drive.limit_switches && axis.axis_type === 'finite'}
          disabled={disabled || axis.axis_type !== 'finite'}
          onChecked={(limit_switches) => set({ limit_switches })}
        >
          {t('axis.generic.limitSwitches')}
        </Checkbox>
      </div>
    </Section>
  );
}
