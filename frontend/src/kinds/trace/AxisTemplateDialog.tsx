import { useState } from 'react';
import { useObjects } from '@/api/queries';
import type { ObjectSummary, Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { applicationOf } from '@/project/tree';
import { Field, Select } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { notifyError } from '@/ui/notices';
import { newRecord, type TraceData } from './configuration';
import { ask, withQuery } from './data/source';
import { usualAppearance } from './usualAppearance';

interface AxisTemplateDialogProps {
  projectId: string;
  object: ObjectSummary;
  data: TraceData;
  onData: (data: TraceData) => void;
  close: (answer?: true) => void;
}

/** The device trace of an axis: a record with its set and actual values, and the lag between both. */
export function AxisTemplateDialog({ projectId, object, data, onData, close }: AxisTemplateDialogProps) {
  const t = useText();
  const { data: objects } = useObjects(projectId);
  const application = objects && applicationOf(objects, object.id)?.id;
  const axes = (objects ?? []).filter(
    (one) => one.kind === 'axis' && applicationOf(objects ?? [], one.id)?.id === application,
  );
  const [chosen, setChosen] = useState<string | null>(null);
  const axis = chosen ?? axes[0]?.name ?? null;
  const add = async () => {
    if (axis === null) return;
    try {
      const path = withQuery('/api/v1/traces/axis-template', { axis });
      const { channels } = await ask<Schemas['AxisTemplate']>(path);
      const record = { ...newRecord(data.records, usualAppearance()), buffer: 2000, channels };
      onData({ ...data, records: [...data.records, record] });
      close(true);
    } catch (error) {
      notifyError(error);
    }
  };
  return (
    <FormDialog
      title={t('trace.axisTemplate')}
      description={t('trace.axisTemplateText')}
      action={t('action.add')}
      disabledReason={axis === null ? t('trace.noAxis') : null}
      onClose={() => close()}
      onSubmit={() => void add()}
    >
      <Field row label={t('trace.axisOf')}>
        {(attributes) => (
          <Select
            {...attributes}
            value={axis}
            placeholder={t('trace.noAxis')}
            choices={axes.map(({ name }) => ({ value: name, text: name }))}
            onValue={setChosen}
          />
        )}
      </Field>
    </FormDialog>
  );
}
