import { useState } from 'react';
import { api } from '@/api/client';
import type { ObjectSummary } from '@/api/types';
import { language, useText } from '@/i18n';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { guard } from '@/ui/notices';
import { saveBlob } from '../downloadFile';
import { usePart } from '../exchange/usePart';

const FORMATS = ['pdf', 'html'] as const;
const PAPERS = ['a4', 'us-letter'] as const;
const LANGUAGES = [
  { value: 'en', text: 'English' },
  { value: 'zh', text: '中文' },
] as const;

interface PrintDialogProps {
  projectId: string;
  projectName: string;
  objects: readonly ObjectSummary[];
  selection: readonly ObjectSummary[];
  /** The object of the editor in front. */
  current: ObjectSummary | null;
  close: () => void;
}

/** The project, or objects of it, as PDF or HTML to be printed. */
export function PrintDialog({ projectId, projectName, objects, selection, current, close }: PrintDialogProps) {
  const t = useText();
  const part = usePart({ projectName, objects, selection, current });
  const [format, setFormat] = useState<(typeof FORMATS)[number]>('pdf');
  const [paper, setPaper] = useState<(typeof PAPERS)[number]>('a4');
  const [words, setWords] = useState<'en' | 'zh'>(language());
  const [footer, setFooter] = useState('');
  const [contents, setContents] = useState(true);
  const [variables, setVariables] = useState(true);
  const [cross, setCross] = useState(false);
  const [busy, setBusy] = useState(false);

  const print = async () => {
    setBusy(true);
    const done = await guard(async () => {
      const blob = await api.download('/api/v1/projects/{project_id}/documentation', {
        params: {
          path: { project_id: projectId },
          query: {
            format,
            paper,
            language: words,
            ...part.request,
            contents,
            variables,
            cross_references: cross,
            footer,
          },
        },
      });
      saveBlob(blob, `${part.name}.${format}`);
      return true;
    });
    setBusy(false);
    if (done) close();
  };

  return (
    <FormDialog
      title={t('command.print')}
      width={480}
      action={t('print.make')}
      disabledReason={busy ? t('reason.busy') : part.reason}
      aside={part.count}
      onClose={close}
      onSubmit={() => void print()}
    >
      {part.field}
      <Field label={t('exchange.format')} hint={t(`print.${format}.hint`)}>
        {(attributes) => (
          <Select
            {...attributes}
            value={format}
            choices={FORMATS.map((value) => ({ value, text: value.toUpperCase() }))}
            onValue={setFormat}
          />
        )}
      </Field>
      {format === 'pdf' && (
        <Field label={t('print.paper')}>
          {(attributes) => (
            <Select
              {...attributes}
              value={paper}
              choices={PAPERS.map((value) => ({ value, text: t(`print.paper.${value}`) }))}
              onValue={setPaper}
            />
          )}
        </Field>
      )}
      <Field label={t('print.language')}>
        {(attributes) => <Select {...attributes} value={words} choices={LANGUAGES} onValue={setWords} />}
      </Field>
      <Field label={t('print.footer')}>
        {(attributes) => <TextInput {...attributes} maxLength={200} value={footer} onValue={setFooter} />}
      </Field>
      <Checkbox checked={contents} onChecked={setContents}>
        {t('print.contents')}
      </Checkbox>
      <Checkbox checked={variables} onChecked={setVariables}>
        {t('print.variables')}
      </Checkbox>
      <Checkbox checked={cross} onChecked={setCross}>
        {t('print.cross')}
      </Checkbox>
    </FormDialog>
  );
}
