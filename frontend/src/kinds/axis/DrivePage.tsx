import type { ReactNode } from 'react';
import { useText, type TextKey } from '@/i18n';
import { Checkbox, Field, Select } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { NumberField } from '@/editors/form/NumberField';
import { numberText } from '@/editors/form/numbers';
import {
  DRIVE_NUMBERS,
  driveFaults,
  eigenfrequencies,
  HOMING_METHODS,
  homingWay,
  missingSwitches,
  type DriveField,
  type GroupName,
  type HomingMethod,
  type SimulatedDrive,
} from './drive';
import styles from './Axis.module.css';
import type { AxisPageProps } from './model';
import { incrementsOfTurn, unitsOfTurns } from './scaling';

/** Motor, loops, encoder, switches and limits of a simulated drive. */
export function DrivePage({ axis, disabled, change }: AxisPageProps) {
  const t = useText();
  const drive = axis.simulated_drive;
  const faults = driveFaults(drive);
  const { motor, switches, homing } = drive;
  const set = <Group extends GroupName>(group: Group, changes: Partial<SimulatedDrive[Group]>) =>
    change({ simulated_drive: { ...drive, [group]: { ...drive[group], ...changes } } });
  const inUnits = (turns: number): string => `≙ ${numberText(unitsOfTurns(turns, axis.scaling))} u`;
  const number = (at: DriveField, { hint, off }: { hint?: string; off?: boolean } = {}): ReactNode => {
    const [group, name] = at.split('.') as [GroupName, string];
    const { unit } = (DRIVE_NUMBERS[group] as Record<string, { unit: string }>)[name]!;
    const value = (drive[group] as unknown as Record<string, number>)[name]!;
    return (
      <NumberField
        key={at}
        label={t(`axis.drive.${at}`)}
        hint={hint}
        unit={unit === 'turns' ? t('axis.turns') : unit}
        value={value}
        error={faults[at] ? t(faults[at]) : null}
        disabled={disabled || off}
        onValue={(entered) => set(group, { [name]: entered })}
      />
    );
  };
  const missing = missingSwitches(drive);
  const wrongMotor = (['motor.inertia', 'motor.load_inertia', 'motor.stiffness'] as const).some((at) => faults[at]);
  const [free, held] = eigenfrequencies(motor);
  return (
    <>
      <Section title={t('axis.drive.motorTitle')}>
        <div className={form.fields}>
          {number('motor.inertia')}
          {number('motor.viscous')}
          {number('motor.dry')}
          <Checkbox checked={motor.elastic} disabled={disabled} onChecked={(elastic) => set('motor', { elastic })}>
            {t('axis.drive.elastic')}
          </Checkbox>
          {number('motor.load_inertia', { off: !motor.elastic })}
          {number('motor.stiffness', { off: !motor.elastic })}
          {number('motor.damping', { off: !motor.elastic })}
        </div>
        {motor.elastic && !wrongMotor && (
          <div className={`${styles.result} code`} data-testid="eigenfrequency">
            {t('axis.drive.eigenfrequency', { free: hertzText(free), held: hertzText(held) })}
          </div>
        )}
        {motor.elastic && <p className={form.note}>{t('axis.drive.elasticText')}</p>}
      </Section>
      <Section title={t('axis.drive.loopsTitle')}>
        <p className={form.note}>{t('axis.drive.loopsText')}</p>
        <div className={form.fields}>
          {number('loops.position_gain')}
          {number('loops.feed_forward', { hint: t('axis.drive.feedForwardHint') })}
          {number('loops.velocity_gain')}
          {number('loops.integral_time', { hint: t('axis.drive.integralHint') })}
          {number('loops.current_time')}
        </div>
      </Section>
      <Section title={t('axis.drive.encoderTitle')}>
        <p className={form.note}>
          {t('axis.drive.encoderText', { increments: numberText(incrementsOfTurn(axis.scaling)) })}
        </p>
        <div className={form.fields}>{number('encoder.noise')}</div>
      </Section>
      <Section title={t('axis.drive.switchesTitle')}>
        <p className={form.note}>{t('axis.drive.switchesText')}</p>
        <div className={form.fields}>
          <Checkbox
            checked={switches.negative}
            disabled={disabled}
            onChecked={(negative) => set('switches', { negative })}
          >
            {t('axis.drive.negative')}
          </Checkbox>
          {number('switches.negative_at', { off: !switches.negative, hint: inUnits(switches.negative_at) })}
          <Checkbox
            checked={switches.positive}
            disabled={disabled}
            onChecked={(positive) => set('switches', { positive })}
          >
            {t('axis.drive.positive')}
          </Checkbox>
          {number('switches.positive_at', { off: !switches.positive, hint: inUnits(switches.positive_at) })}
          <Checkbox checked={switches.home} disabled={disabled} onChecked={(home) => set('switches', { home })}>
            {t('axis.drive.home')}
          </Checkbox>
          {number('switches.home_from', { off: !switches.home, hint: inUnits(switches.home_from) })}
          {number('switches.home_to', { off: !switches.home, hint: inUnits(switches.home_to) })}
          <MethodField method={homing.method} disabled={disabled} onMethod={(method) => set('homing', { method })} />
          {number('homing.velocity', { hint: t('axis.drive.velocityHint') })}
          {number('homing.zero_velocity', { hint: t('axis.drive.zeroVelocityHint') })}
          {number('homing.acceleration', { hint: t('axis.drive.accelerationHint') })}
        </div>
        {missing.length > 0 && (
          <div className={form.banner} data-tone="warn">
            {t('axis.drive.missing', {
              method: homing.method,
              switches: missing.map((name) => t(`axis.drive.${name}`)).join(', '),
            })}
          </div>
        )}
      </Section>
      <Section title={t('axis.drive.limitsTitle')}>
        <div className={form.fields}>
          {number('limits.rated_torque', { hint: t('axis.drive.ratedTorqueHint') })}
          {number('limits.max_torque')}
          {number('limits.lag', { hint: t('axis.drive.lagHint') })}
          {number('limits.quick_stop')}
        </div>
      </Section>
    </>
  );
}

function hertzText(hertz: number): string {
  return numberText(Number(hertz.toPrecision(4)));
}

interface MethodFieldProps {
  method: HomingMethod;
  disabled: boolean;
  onMethod: (method: HomingMethod) => void;
}

function MethodField({ method, disabled, onMethod }: MethodFieldProps) {
  const t = useText();
  const text = (one: HomingMethod): string => {
    const { way, pulse } = homingWay(one);
    const key: TextKey = pulse ? 'axis.method.withPulse' : 'axis.method.alone';
    return t(key, { method: one, way: t(`axis.method.${way as Exclude<HomingMethod, WithoutPulse>}`) });
  };
  return (
    <Field row label={t('axis.drive.method')} hint={t('axis.drive.methodHint')}>
      {(attributes) => (
        <Select<string>
          {...attributes}
          disabled={disabled}
          value={String(method)}
          choices={HOMING_METHODS.map((one) => ({ value: String(one), text: text(one) }))}
          onValue={(chosen) => onMethod(Number(chosen) as HomingMethod)}
        />
      )}
    </Field>
  );
}

/** Methods that have the text of another one. */
type WithoutPulse = 17 | 18 | 19 | 20 | 21 | 22 | 23 | 24 | 25 | 26 | 27 | 28 | 29 | 30;
