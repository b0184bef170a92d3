import { useText } from '@/i18n';
import { Checkbox, Field, Select } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { NumberField } from '@/editors/form/NumberField';
import { axisFaults, type AxisPageProps, type AxisSettings, type FieldName, hasDrive, isLogical } from './model';

/** Whether the axis is rotary or linear, with its period or its ends (AXIS-10 to AXIS-13, AXIS-31). */
export function AxisTypeSection({ axis, disabled, change }: Pick<AxisPageProps, 'axis' | 'disabled' | 'change'>) {
  const t = useText();
  const faults = axisFaults(axis);
  const fault = (field: FieldName) => (faults[field] ? t(faults[field]) : null);
  const limits = axis.software_limits;
  const changeLimits = (changes: Partial<typeof limits>) => change({ software_limits: { ...limits, ...changes } });
  return (
    <Section title={t('axis.type')}>
      <div className={form.fields}>
        {!isLogical(axis) && (
          <Checkbox
            checked={axis.virtual_mode || !hasDrive(axis)}
            disabled={disabled || !hasDrive(axis)}
            onChecked={(virtual_mode) => change({ virtual_mode })}
          >
            {t('axis.virtualMode')}
          </Checkbox>
        )}
        <Field row label={t('axis.axisType')}>
          {(attributes) => (
            <Select<AxisSettings['axis_type']>
              {...attributes}
              disabled={disabled}
              value={axis.axis_type}
              choices={[
                { value: 'modulo', text: t('axis.modulo') },
                { value: 'finite', text: t('axis.finite') },
              ]}
              onValue={(axis_type) => change({ axis_type })}
            />
          )}
        </Field>
        {axis.axis_type === 'modulo' ? (
          <NumberField
            label={t('axis.moduloValue')}
            hint={t('axis.moduloHint')}
            unit="u"
            value={axis.modulo}
            error={fault('modulo')}
            disabled={disabled}
            onValue={(modulo) => change({ modulo })}
          />
        ) : (
          <>
            <Checkbox checked={limits.enabled} disabled={disabled} onChecked={(enabled) => changeLimits({ enabled })}>
              {t('axis.softwareLimits')}
            </Checkbox>
            <NumberField
              label={t('axis.negative')}
              unit="u"
              value={limits.negative}
              error={fault('negative')}
              disabled={disabled || !limits.enabled}
              onValue={(negative) => changeLimits({ negative })}
            />
            <NumberField
              label={t('axis.positive')}
              unit="u"
              value={limits.positive}
              error={fault('positive')}
              disabled={disabled || !limits.enabled}
              onValue={(positive) => changeLimits({ positive })}
            />
            <NumberField
              label={t('axis.limitDeceleration')}
              hint={t('axis.limitDecelerationHint')}
              unit="u/s²"
              value={limits.deceleration}
              error={fault('limit_deceleration')}
              disabled={disabled || !limits.enabled}
              onValue={(deceleration) => changeLimits({ deceleration })}
            />
          </>
        )}
      </div>
    </Section>
  );
}
