import { useState } from 'react';
import { api } from '@/api/client';
import type { ObjectSummary } from '@/api/types';
import { language, useText } from '@/i18n';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { guard } from '@/ui/notices';
import { saveBlob } from '../downloadFile';

const FORMATS = ['pdf', 'html'] as const;
const PAPERS = ['a4', 'us-letter'] as const;
const LANGUAGES = [
  { value: 'en', text: 'English' },
  { value: 'zh', text: '中文' },
] as const;
type Scope = 'whole' | 'selection' | 'editor';

interface PrintDialogProps {
  projectId: string;
  projectName: string;
  selection: readonly ObjectSummary[];
  /** The object of the editor in front. */
  current: ObjectSummary | null;
  close: () => void;
}

/** The project, what is selected of it, or the object in the editor, as PDF or HTML to be printed. */
export function PrintDialog({ projectId, projectName, selection, current, close }: PrintDialogProps) {
  const t = useText();
  const [scope, setScope] = useState<Scope>('whole');
  const [format, setFormat] = useState<(typeof FORMATS)[number]>('pdf');
  const [paper, setPaper] = useState<(typeof PAPERS)[number]>('a4');
  const [words, setWords] = useState<'en' | 'zh'>(language());
  const [footer, setFooter] = useState('');
  const [contents, setContents] = useState(true);
  const [variables, setVariables] = useState(true);
  const [cross, setCross] = useState(false);
  const [busy, setBusy] = useState(false);
  const objects = scope === 'selection' ? selection : scope === 'editor' && current ? [current] : [];

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
            object: objects.map(({ id }) => id),
            contents,
            variables,
            cross_references: cross,
            footer,
          },
        },
      });
      saveBlob(blob, `${objects.length === 1 ? objects[0]!.name : projectName}.${format}`);
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
      disabledReason={busy ? t('reason.busy') : null}
      onClose={close}
      onSubmit={() => void print()}
    >
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
              {
                value: 'editor',
                text: current ? t('print.editor', { name: current.name }) : t('print.noEditor'),
                disabled: current === null,
              },
            ]}
            onValue={setScope}
          />
        )}
      </Field>
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
