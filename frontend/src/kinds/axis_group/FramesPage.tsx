import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { groupFaults, type GroupPageProps } from './model';
import { ValueTable } from './ValueTable';

const PRODUCTS = { pcs_1: 'axisGroup.pcs_1', pcs_2: 'axisGroup.pcs_2' } as const;
const ROWS = {
  x: { text: 'axisGroup.coordinate.x', unit: 'u' },
  y: { text: 'axisGroup.coordinate.y', unit: 'u' },
  z: { text: 'axisGroup.coordinate.z', unit: 'u' },
  a: { text: 'axisGroup.coordinate.a', unit: '°' },
  b: { text: 'axisGroup.coordinate.b', unit: '°' },
  c: { text: 'axisGroup.coordinate.c', unit: '°' },
} as const;

/** Where the products lie in the machine when the controller starts; a program can move them. */
export function FramesPage({ group, disabled, change }: GroupPageProps) {
  const t = useText();
  return (
    <Section title={t('axisGroup.frames')}>
      <p className={form.note}>{t('axisGroup.framesText')}</p>
      <ValueTable
        columns={PRODUCTS}
        rows={ROWS}
        values={group}
        faults={groupFaults(group)}
        disabled={disabled}
        onValue={(product, name, value) => change({ [product]: { ...group[product], [name]: value } })}
      />
    </Section>
  );
}
