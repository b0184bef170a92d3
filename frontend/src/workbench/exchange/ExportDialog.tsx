import { useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { api } from '@/api/client';
import { saveBlob } from '../downloadFile';
import { guard } from '@/ui/notices';
import { FormDialog } from '@/ui/FormDialog';
import { Field, Select } from '@/ui/Field';

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
  selection: readonly ObjectSummary[];
  close: () => void;
}

/** The project, or what is selected of it with all below, as our archive, PLCopen XML or ST. */
export function ExportDialog({ projectId, projectName, selection, close }: ExportDialogProps) {
  const t = useText();
  const [format, setFormat] = useState<Format>('archive');
  const [scope, setScope] = useState<'whole' | 'selection'>('whole');
  const save = async () => {
    const objects = scope === 'selection' ? selection : [];
    const single = objects.length === 1 ? objects[0] : undefined;
    const name = single?.name ?? projectName;
    const done = await guard(async () => {
      const params = { path: { project_id: projectId }, query: { object: objects.map(({ id }) => id) } };
      const blob = await api.download(PATHS[format], { params });
      saveBlob(blob, `${name}.${endingOf(format, blob.type)}`);
      return true;
    });
    if (done) close();
  };
  return (
    <FormDialog
      title={t('command.export')}
      width={440}
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
      <Field label={t('exchange.scope')}>
        {(attributes) => (
          <Select
            {...attributes}
            value={scope}
            choices={[
              { value: 'whole', text: t('exchange.wholeProject') },
              {
                value: 'selection',
                text: selection.length
                  ? t('exchange.selection', { names: selection.map(({ name }) => name).join(', ') })
                  : t('exchange.noSelection'),
                disabled: selection.length === 0,
              },
            ]}
            onValue={setScope}
          />
        )}
      </Field>
    </FormDialog>
  );
}

/** Several ST texts come as an archive. */
function endingOf(format: Format, type: string): string {
  if (format === 'plcopen') return 'xml';
  return format === 'st' && type.startsWith('text/') ? 'st' : 'zip';
}
