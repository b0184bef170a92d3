import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { groupFaults, type GroupPageProps } from './model';
import { ValueTable } from './ValueTable';

const SETS = {
  limits: 'axisGroup.limitsHead',
  defaults: 'axisGroup.defaultsHead',
  jogging: 'axisGroup.joggingHead',
} as const;
const ROWS = {
  velocity: { text: 'axis.limit.velocity', unit: 'u/s' },
  acceleration: { text: 'axis.limit.acceleration', unit: 'u/s²' },
  deceleration: { text: 'axis.limit.deceleration', unit: 'u/s²' },
  jerk: { text: 'axis.limit.jerk', unit: 'u/s³' },
} as const;

/** What no movement along a path exceeds, and what movements do whose blocks say 0. */
export function LimitsPage({ group, disabled, change }: GroupPageProps) {
  const t = useText();
  return (
    <Section title={t('axisGroup.limits')}>
      <p className={form.note}>{t('axisGroup.limitsText')}</p>
      <ValueTable
        columns={SETS}
        rows={ROWS}
        values={group}
        faults={groupFaults(group)}
        disabled={disabled}
        onValue={(set, name, value) => change({ [set]: { ...group[set], [name]: value } })}
      />
    </Section>
  );
}
