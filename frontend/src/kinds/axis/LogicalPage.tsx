import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { Field, Select } from '@/ui/Field';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { NumberField } from '@/editors/form/NumberField';
import { AxisTypeSection } from './AxisTypeSection';
import { BusTaskField } from './BusTaskField';
import { axisFaults, type AxisPageProps, type AxisSettings, type FieldName } from './model';

type Mirroring = AxisSettings['mirroring'];

/** What a logical axis mirrors, and how (devices.md, 14.4). */
export function LogicalPage({ projectId, objectId, axis, disabled, change }: AxisPageProps) {
  const t = useText();
  const { mirroring } = axis;
  const faults = axisFaults(axis);
  const fault = (field: FieldName) => (faults[field] ? t(faults[field]) : null);
  const set = (changes: Partial<Mirroring>) => change({ mirroring: { ...mirroring, ...changes } });
  return (
    <>
      <AxisTypeSection axis={axis} disabled={disabled} change={change} />
      <Section title={t('axis.logical.master')}>
        <p className={form.note}>{t('axis.logical.text')}</p>
        <div className={form.fields}>
          <MasterField
            projectId={projectId}
            objectId={objectId}
            value={mirroring.master}
            disabled={disabled}
            onValue={(master) => set({ master })}
          />
          <Field row label={t('axis.logical.reference')}>
            {(attributes) => (
              <Select<Mirroring['reference']>
                {...attributes}
                disabled={disabled}
                value={mirroring.reference}
                choices={[
                  { value: 'set', text: t('axis.logical.set') },
                  { value: 'actual', text: t('axis.logical.actual') },
                ]}
                onValue={(reference) => set({ reference })}
              />
            )}
          </Field>
          <NumberField
            label={t('axis.deadTime')}
            hint={t('axis.logical.deadTimeHint')}
            unit={t('axis.cycles')}
            value={mirroring.dead_time}
            error={fault('mirroring.dead_time')}
            disabled={disabled}
            onValue={(dead_time) => set({ dead_time })}
          />
          {(['position_filter', 'velocity_filter'] as const).map((name) => (
            <NumberField
              key={name}
              label={t(`axis.logical.${name}`)}
              hint={name === 'position_filter' ? t('axis.logical.filterHint') : undefined}
              unit={t('axis.cycles')}
              value={mirroring[name]}
              error={fault(`mirroring.${name}`)}
              disabled={disabled}
              onValue={(value) => set({ [name]: value })}
            />
          ))}
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

interface MasterFieldProps {
  projectId: string;
  objectId: string;
  value: string;
  disabled: boolean;
  onValue: (master: string) => void;
}

/** The axes of the same pool; one that is gone is still shown, with what is wrong. */
function MasterField({ projectId, objectId, value, disabled, onValue }: MasterFieldProps) {
  const t = useText();
  const { data: objects } = useObjects(projectId);
  const pool = objects?.find((object) => object.id === objectId)?.parent_id;
  const axes = (objects ?? []).filter((one) => one.kind === 'axis' && one.parent_id === pool && one.id !== objectId);
  const chosen = axes.find((axis) => axis.name.toUpperCase() === value.toUpperCase())?.name;
  const gone = value !== '' && objects !== undefined && chosen === undefined;
  return (
    <Field
      row
      label={t('axis.logical.master')}
      error={gone ? t('axis.logical.noAxis', { name: value }) : value === '' ? t('axis.logical.noMaster') : null}
    >
      {(attributes) => (
        <Select
          {...attributes}
          disabled={disabled}
          value={chosen ?? value}
          choices={[...axes.map((axis) => axis.name), ...(gone ? [value] : [])].map((name) => ({
            value: name,
            text: name,
          }))}
          onValue={onValue}
        />
      )}
    </Field>
  );
}
