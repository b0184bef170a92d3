import { useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { api } from '@/api/client';
import { saveBlob } from '../downloadFile';
import { guard } from '@/ui/notices';
import { FormDialog } from '@/ui/FormDialog';
import { Field, Select } from '@/ui/Field';
import { usePart } from './usePart';

const FORMATS = ['archive', 'plcopen', 'st'] as const;
type Format = (typeof FORMATS)[number];
const PATHS = {
  archive: '/api/v1/projects/{project_id}/export',
  plcopen: '/api/v1/projects/{project_id}/export/plcopen',
  st: '/api/v1/projects/{project_id}/export/st',
} as const satisfies Record<Format, string>;

interface ExportDialogProps {
  projectId: string;
  projectName: string;
  objects: readonly ObjectSummary[];
  selection: readonly ObjectSummary[];
  close: () => void;
}

/** The project, or objects of it, as our archive, PLCopen XML or ST. */
export function ExportDialog({ projectId, projectName, objects, selection, close }: ExportDialogProps) {
  const t = useText();
  const [format, setFormat] = useState<Format>('archive');
  const part = usePart({ projectName, objects, selection });
  const save = async () => {
    const done = await guard(async () => {
      const params = { path: { project_id: projectId }, query: part.request };
      const blob = await api.download(PATHS[format], { params });
      saveBlob(blob, `${part.name}.${endingOf(format, blob.type)}`);
      return true;
    });
    if (done) close();
  };
  return (
    <FormDialog
      title={t('command.export')}
      width={480}
      disabledReason={part.reason}
      aside={part.count}
      onClose={close}
      onSubmit={() => void save()}
      action={t('exchange.export')}
    >
      <Field label={t('exchange.format')} hint={t(`exchange.format.${format}.hint`)}>
        {(attributes) => (
          <Select
            {...attributes}
            value={format}
            choices={FORMATS.map((value) => ({ value, text: t(`exchange.format.${value}`) }))}
            onValue={setFormat}
          />
        )}
      </Field>
      {part.field}
    </FormDialog>
  );
}

/** Several ST texts come as an archive. */
function endingOf(format: Format, type: string): string {
  if (format === 'plcopen') return 'xml';
  return format === 'st' && type.startsWith('text/') ? 'st' : 'zip';
}
