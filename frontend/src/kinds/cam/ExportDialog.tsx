import { useState } from 'react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { NumberField } from '@/editors/form/NumberField';
import { saveBlob } from '@/workbench/downloadFile';
import { Field, Select } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { notifyError } from '@/ui/notices';
import type { CamTable } from './camTable';

const FORMATS = ['ascii', 'csv', 'cam'] as const;
type Format = (typeof FORMATS)[number];
const ENDINGS: Readonly<Record<Format, string>> = { ascii: 'txt', csv: 'csv', cam: 'cam' };
const MOST = 10_000;

interface ExportDialogProps {
  projectId: string;
  name: string;
  cam: CamTable;
  close: (answer?: true) => void;
}

/** Writes a cam as ASCII table, CSV, or the file that the program reads (CAM-81, CAM-82). */
export function ExportDialog({ projectId, name, cam, close }: ExportDialogProps) {
  const t = useText();
  const [format, setFormat] = useState<Format>('ascii');
  const [points, setPoints] = useState<'equal' | 'own'>('equal');
  const [count, setCount] = useState(256);
  const counted = format !== 'cam' && points === 'equal';
  const fault =
    !counted || (Number.isInteger(count) && count >= 2 && count <= MOST)
      ? null
      : t('cam.fault.tableSize', { greatest: MOST });
  const write = async () => {
    try {
      const { text } = await api.post('/api/v1/projects/{project_id}/cams/text', {
        params: { path: { project_id: projectId } },
        body: { cam, format, count: counted ? count : 2, points_only: points === 'own', name },
      });
      saveBlob(new Blob([text], { type: 'text/plain' }), `${name}.${ENDINGS[format]}`);
      close(true);
    } catch (error) {
      notifyError(error);
    }
  };
  return (
    <FormDialog
      title={t('cam.export')}
      description={t(`cam.exportText.${format}`)}
      action={t('cam.exportAction')}
      disabledReason={fault}
      onClose={() => close()}
      onSubmit={() => void write()}
    >
      <Field row label={t('cam.fileFormat')}>
        {(attributes) => (
          <Select<Format>
            {...attributes}
            value={format}
            choices={FORMATS.map((value) => ({ value, text: t(`cam.file.${value}`) }))}
            onValue={setFormat}
          />
        )}
      </Field>
      {format !== 'cam' && (
        <Field row label={t('cam.points')}>
          {(attributes) => (
            <Select<'equal' | 'own'>
              {...attributes}
              value={points}
              choices={[
                { value: 'equal', text: t('cam.pointsEqual') },
                { value: 'own', text: t('cam.pointsOwn', { count: cam.points.length }) },
              ]}
              onValue={setPoints}
            />
          )}
        </Field>
      )}
      {counted && <NumberField label={t('cam.count')} value={count} error={fault} onValue={setCount} />}
    </FormDialog>
  );
}
