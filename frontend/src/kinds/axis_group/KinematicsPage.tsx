import { useText, type TextKey } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { NumberField } from '@/editors/form/NumberField';
import { Field, Select } from '@/ui/Field';
import { formOf, isFlag, TYPES, unitOf, withType, type KinematicsType } from './kinematics';
import { groupFaults, type GroupPageProps } from './model';

/** Stands for no choice: a choice of the list needs a value. */
const NONE = ' ';

/** What leads from the axes to the machine and back, with its lengths and the offsets of its axes. */
export function KinematicsPage({ group, disabled, change }: GroupPageProps) {
  const t = useText();
  const { kinematics } = group;
  const { type, offsets, parameters } = kinematics;
  const known = formOf(type);
  const faults = groupFaults(group);
  const fault = (key: TextKey | undefined) => (key ? t(key) : null);
  const set = (name: string, value: number) =>
    change({ kinematics: { ...kinematics, parameters: { ...parameters, [name]: value } } });
  const setOffset = (index: number, value: number) =>
    change({ kinematics: { ...kinematics, offsets: offsets.map((old, at) => (at === index ? value : old)) } });
  const missing = known !== null && group.axes.length < known.axes;
  return (
    <Section title={t('axisGroup.page.kinematics')}>
      <p className={form.note}>{t('axisGroup.kinematicsText')}</p>
      <div className={form.fields}>
        <Field
          row
          label={t('axisGroup.kinematics')}
          hint={type === '' ? undefined : t(`axisGroup.kin.${type}`)}
          error={missing ? t('axisGroup.tooFew', { axes: known.axes, count: group.axes.length }) : null}
        >
          {(attributes) => (
            <Select<KinematicsType | typeof NONE>
              {...attributes}
              disabled={disabled}
              value={type === '' ? NONE : type}
              choices={[
                { value: NONE, text: t('axisGroup.noKinematics') },
                ...TYPES.map((one) => ({ value: one, text: one })),
              ]}
              onValue={(next) => change({ kinematics: withType(kinematics, next === NONE ? '' : next) })}
            />
          )}
        </Field>
        {known?.parameters.map((name) =>
          isFlag(name) ? (
            <Field key={name} row label={name}>
              {(attributes) => (
                <Select
                  {...attributes}
                  disabled={disabled}
                  value={parameters[name] ? 'TRUE' : 'FALSE'}
                  choices={['TRUE', 'FALSE'].map((value) => ({ value, text: value }))}
                  onValue={(value) => set(name, value === 'TRUE' ? 1 : 0)}
                />
              )}
            </Field>
          ) : (
            <NumberField
              key={name}
              label={name}
              unit={unitOf(name)}
              value={parameters[name] ?? 0}
              error={fault(faults[`parameters.${name}`])}
              disabled={disabled}
              onValue={(value) => set(name, value)}
            />
          ),
        )}
        {offsets.slice(0, known?.axes ?? 0).map((offset, index) => (
          <NumberField
            key={index}
            label={t('axisGroup.offset', { index: index + 1 })}
            hint={index === 0 ? t('axisGroup.offsetHint') : undefined}
            unit="u"
            value={offset}
            error={fault(faults[`offsets.${index}`])}
            disabled={disabled}
            onValue={(value) => setOffset(index, value)}
          />
        ))}
      </div>
    </Section>
  );
}
