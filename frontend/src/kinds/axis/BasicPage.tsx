import { useText } from '@/i18n';
import { Field, Select } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import styles from './Axis.module.css';
import { AxisTypeSection } from './AxisTypeSection';
import { BusTaskField } from './BusTaskField';
import {
  axisFaults,
  beyondDrive,
  hasDrive,
  LIMIT_NAMES,
  type AxisPageProps,
  type AxisSettings,
  type FieldName,
} from './model';
import { NumberCell, NumberField } from '@/editors/form/NumberField';

const RAMPS: readonly AxisSettings['ramp_type'][] = ['trapez', 'sin2', 'quadratic', 'quadratic_smooth'];
const UNITS = { velocity: 'u/s', acceleration: 'u/s²', deceleration: 'u/s²', jerk: 'u/s³' } as const;

/** Type, limits, ramp type and bus task of an axis (devices.md, 14.2). */
export function BasicPage({ projectId, objectId, axis, disabled, change }: AxisPageProps) {
  const t = useText();
  const faults = axisFaults(axis);
  const fault = (field: FieldName) => (faults[field] ? t(faults[field]) : null);
  const beyond = beyondDrive(axis);
  const faultyLimits = LIMIT_NAMES.flatMap((name) =>
    (
      [
        ['axis.dynamicLimits', name, faults[`dynamic.${name}`]],
        ['axis.driveLimits', name, faults[`drive.${name}`]],
      ] as const
    ).flatMap(([set, limit, wrong]) => (wrong ? [[set, limit, wrong] as const] : [])),
  );
  return (
    <>
      <AxisTypeSection axis={axis} disabled={disabled} change={change} />
      <Section title={t('axis.limits')}>
        <p className={form.note}>{t('axis.limitsText')}</p>
        <div className={styles.limits}>
          <span />
          <span className={styles.head}>{t('axis.dynamicLimits')}</span>
          <span className={styles.head}>{t('axis.driveLimits')}</span>
          <span />
          {LIMIT_NAMES.map((name) => (
            <div key={name} style={{ display: 'contents' }}>
              <span>{t(`axis.limit.${name}`)}</span>
              <NumberCell
                label={`${t('axis.dynamicLimits')}: ${t(`axis.limit.${name}`)}`}
                value={axis.dynamic_limits[name]}
                invalid={faults[`dynamic.${name}`] !== undefined}
                disabled={disabled}
                onValue={(value) => change({ dynamic_limits: { ...axis.dynamic_limits, [name]: value } })}
              />
              <NumberCell
                label={`${t('axis.driveLimits')}: ${t(`axis.limit.${name}`)}`}
                value={axis.drive_limits[name]}
                invalid={faults[`drive.${name}`] !== undefined}
                disabled={disabled}
                onValue={(value) => change({ drive_limits: { ...axis.drive_limits, [name]: value } })}
              />
              <span className={styles.unit}>{UNITS[name]}</span>
            </div>
          ))}
        </div>
        <ul className={styles.faults} role="alert">
          {faultyLimits.map(([set, name, wrong]) => (
            <li key={`${set}.${name}`}>
              {t('axis.faultAt', { field: `${t(set)}, ${t(`axis.limit.${name}`)}`, fault: t(wrong) })}
            </li>
          ))}
        </ul>
        {beyond.length > 0 && (
          <div className={form.banner} data-tone="warn">
            {t('axis.beyondDrive', { limits: beyond.map((name) => t(`axis.limit.${name}`)).join(', ') })}
          </div>
        )}
      </Section>
      <Section title={t('axis.ramps')}>
        <div className={form.fields}>
          <Field row label={t('axis.rampType')} hint={t(`axis.ramp.${axis.ramp_type}Text`)}>
            {(attributes) => (
              <Select<AxisSettings['ramp_type']>
                {...attributes}
                disabled={disabled}
                value={axis.ramp_type}
                choices={RAMPS.map((ramp) => ({ value: ramp, text: t(`axis.ramp.${ramp}`) }))}
                onValue={(ramp_type) => change({ ramp_type })}
              />
            )}
          </Field>
          <NumberField
            label={t('axis.stoppingDistance')}
            hint={t('axis.stoppingDistanceHint')}
            unit="u"
            value={axis.stopping_distance}
            error={fault('stopping_distance')}
            disabled={disabled}
            onValue={(stopping_distance) => change({ stopping_distance })}
          />
          {hasDrive(axis) && (
            <NumberField
              label={t('axis.positionLag')}
              hint={t('axis.positionLagHint')}
              unit="u"
              value={axis.position_lag}
              error={fault('position_lag')}
              disabled={disabled}
              onValue={(position_lag) => change({ position_lag })}
            />
          )}
          <BusTaskField
            projectId={projectId}
            objectId={objectId}
            value={axis.bus_task}
            automatic={t('axis.automatic')}
            disabled={disabled}
            onValue={(bus_task) => change({ bus_task })}
          />
        </div>
      </Section>
    </>
  );
}
