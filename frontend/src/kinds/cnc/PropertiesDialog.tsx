import { useState } from 'react';
import { ofKind } from '@/api/objects';
import { useObject } from '@/api/queries';
import { NumberField } from '@/editors/form/NumberField';
import { useText } from '@/i18n';
import { Loading } from '@/ui/Empty';
import { Field, Select } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { useRefusal } from '@/ui/useRefusal';
import { mayEdit } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import { useCommandContext } from '@/workbench/useCommandContext';
import styles from './Cnc.module.css';
import { AXES } from './gcodes';
import {
  COMPILE_MODES,
  FARTHEST,
  GREATEST_RATE,
  LEAST_QUEUE,
  MOST_QUEUE,
  saveProperties,
  startOf,
  VIEWS,
  withStart,
  type CncPropertyData,
} from './properties';

interface PropertiesDialogProps {
  projectId: string;
  objectId: string;
  name: string;
  close: () => void;
}

const RATES = ['velocity', 'acceleration', 'deceleration'] as const;
const UNITS = { velocity: 'u/s', acceleration: 'u/s²', deceleration: 'u/s²' } as const;

/** The tab CNC of the properties (CNC-10 to CNC-16). */
export function PropertiesDialog({ projectId, objectId, name, close }: PropertiesDialogProps) {
  const t = useText();
  const { data: object } = useObject(projectId, objectId, ofKind('cnc'));
  const [change, setChange] = useState<Partial<CncPropertyData>>({});
  const [refused, ask] = useRefusal();
  const allowed = mayEdit(useCommandContext());
  if (!object) return <Loading />;
  const data = { ...object.data, ...change };
  const set = (part: Partial<CncPropertyData>) => setChange({ ...change, ...part });
  const rateFault = (value: number) =>
    value >= 0 && value <= GREATEST_RATE ? null : t('cnc.range', { least: 0, greatest: GREATEST_RATE });
  const queueFault =
    Number.isInteger(data.queue_size) && data.queue_size >= LEAST_QUEUE && data.queue_size <= MOST_QUEUE
      ? null
      : t('cnc.wholeRange', { least: LEAST_QUEUE, greatest: MOST_QUEUE });
  const placeFault = (value: number) =>
    Math.abs(value) <= FARTHEST ? null : t('cnc.range', { least: -FARTHEST, greatest: FARTHEST });
  const faults = [queueFault, ...RATES.map((rate) => rateFault(data[rate])), ...startOf(data).map(placeFault)];
  const disabled = allowed !== true;
  return (
    <FormDialog
      title={t('cnc.propertiesOf', { name })}
      width={800}
      action={t('properties.apply')}
      disabledReason={disabled ? reasonText(allowed) : (faults.find((fault) => fault !== null) ?? null)}
      onClose={close}
      onSubmit={() =>
        void ask(async () => {
          await saveProperties(projectId, objectId, change);
          close();
        })
      }
    >
      <div className={styles.fields}>
        <Field row label={t('cnc.implementation')} error={refused}>
          {(attributes) => (
            <Select
              {...attributes}
              value={data.view}
              disabled={disabled}
              choices={VIEWS.map((value) => ({ value, text: t(`cnc.implementation.${value}`) }))}
              onValue={(view) => set({ view })}
            />
          )}
        </Field>
        <Field row label={t('cnc.compileMode')}>
          {(attributes) => (
            <Select
              {...attributes}
              value={data.compile_mode}
              disabled={disabled}
              choices={COMPILE_MODES.map((value) => ({ value, text: t(`cnc.mode.${value}`) }))}
              onValue={(compile_mode) => set({ compile_mode })}
            />
          )}
        </Field>
        <NumberField
          label={t('cnc.queueSize')}
          value={data.queue_size}
          error={queueFault}
          disabled={disabled}
          onValue={(queue_size) => set({ queue_size })}
        />
        {RATES.map((rate) => (
          <NumberField
            key={rate}
            label={t(`cnc.${rate}`)}
            unit={UNITS[rate]}
            value={data[rate]}
            error={rateFault(data[rate])}
            disabled={disabled}
            onValue={(value) => set({ [rate]: value })}
          />
        ))}
      </div>
      <h3 className={styles.heading}>{t('cnc.start')}</h3>
      <div className={styles.fields}>
        {[...AXES].map((letter, axis) => (
          <NumberField
            key={letter}
            label={letter}
            value={startOf(data)[axis]!}
            error={placeFault(startOf(data)[axis]!)}
            disabled={disabled}
            onValue={(value) => set({ start: withStart(data.start, letter, value) })}
          />
        ))}
      </div>
    </FormDialog>
  );
}
