import { useState } from 'react';
import { useText } from '@/i18n';
import { Checkbox, Field, Select } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { notifyError } from '@/ui/notices';
import type { TraceRecord } from './configuration';
import type { TraceOnline } from './online';

const FORMATS = ['csv', 'parquet'] as const;
type Format = (typeof FORMATS)[number];

interface ExportDialogProps {
  records: readonly TraceRecord[];
  online: TraceOnline;
  close: (answer?: true) => void;
}

/** Writes the samples of a record as CSV or Parquet. */
export function ExportDialog({ records, online, close }: ExportDialogProps) {
  const t = useText();
  const [format, setFormat] = useState<Format>('csv');
  const [record, setRecord] = useState('0');
  const [formulas, setFormulas] = useState(true);
  const write = async () => {
    try {
      await online.save(format, Number(record), formulas);
      close(true);
    } catch (error) {
      notifyError(error);
    }
  };
  return (
    <FormDialog
      title={t('trace.export')}
      description={t('trace.exportText')}
      action={t('trace.exportAction')}
      onClose={() => close()}
      onSubmit={() => void write()}
    >
      <Field row label={t('trace.format')}>
        {(attributes) => (
          <Select<Format>
            {...attributes}
            value={format}
            choices={FORMATS.map((value) => ({ value, text: t(`trace.format.${value}`) }))}
            onValue={setFormat}
          />
        )}
      </Field>
      {records.length > 1 && (
        <Field row label={t('trace.record')}>
          {(attributes) => (
            <Select
              {...attributes}
              value={record}
              choices={records.map(({ name }, at) => ({ value: String(at), text: name }))}
              onValue={setRecord}
            />
          )}
        </Field>
      )}
      {records[Number(record)]?.channels.some(({ formula }) => formula.trim() !== '') && (
        <Checkbox checked={formulas} onChecked={setFormulas}>
          {t('trace.exportFormulas')}
        </Checkbox>
      )}
    </FormDialog>
  );
}
