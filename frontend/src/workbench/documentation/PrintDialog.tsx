import { FileCog } from 'lucide-react';
import { useState } from 'react';
import { api } from '@/api/client';
import type { ObjectSummary, Schemas } from '@/api/types';
import { language, useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { guard } from '@/ui/notices';
import { saveBlob } from '../downloadFile';
import { usePart } from '../exchange/usePart';

const FORMATS = ['pdf', 'html'] as const;
const PAPERS = ['a3', 'a4', 'a5', 'us-letter', 'us-legal', 'us-tabloid'] as const;
type Printed = Pick<Schemas['PageSetupData'], 'paper' | 'contents' | 'variables' | 'cross_references'>;
/** What holds in a project without a page setup. */
const USUAL: Printed = { paper: 'a4', contents: true, variables: true, cross_references: false };
const SWITCHES = [
  { name: 'contents', text: 'print.contents' },
  { name: 'variables', text: 'print.variables' },
  { name: 'cross_references', text: 'print.cross' },
] as const;
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
  /** Of the project; undefined: there is none. */
  setup: Schemas['PageSetupData'] | undefined;
  openSetup: () => void;
  close: () => void;
}

/** The project, or objects of it, as PDF or HTML to be printed; what is not changed here is as the page setup has it. */
export function PrintDialog(props: PrintDialogProps) {
  const { projectId, projectName, objects, selection, current, setup, openSetup, close } = props;
  const t = useText();
  const part = usePart({ projectName, objects, selection, current });
  const [format, setFormat] = useState<(typeof FORMATS)[number]>('pdf');
  const [instead, setInstead] = useState<Partial<Printed>>({});
  const printed: Printed = { ...(setup ?? USUAL), ...instead };
  const [words, setWords] = useState<'en' | 'zh'>(language());
  const [footer, setFooter] = useState(setup?.footer.left ?? '');
  const [busy, setBusy] = useState(false);

  const print = async () => {
    setBusy(true);
    const done = await guard(async () => {
      const blob = await api.download('/api/v1/projects/{project_id}/documentation', {
        params: {
          path: { project_id: projectId },
          query: {
            format,
            language: words,
            ...part.request,
            ...instead,
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
      <Field label={t('print.paper')}>
        {(attributes) => (
          <Select
            {...attributes}
            value={printed.paper}
            choices={PAPERS.map((value) => ({ value, text: t(`print.paper.${value}`) }))}
            onValue={(paper) => setInstead({ ...instead, paper })}
          />
        )}
      </Field>
      <Field label={t('print.language')}>
        {(attributes) => <Select {...attributes} value={words} choices={LANGUAGES} onValue={setWords} />}
      </Field>
      <Field label={t('print.footer')}>
        {(attributes) => <TextInput {...attributes} maxLength={200} value={footer} onValue={setFooter} />}
      </Field>
      {SWITCHES.map(({ name, text }) => (
        <Checkbox
          key={name}
          checked={printed[name]}
          onChecked={(checked) => setInstead({ ...instead, [name]: checked })}
        >
          {t(text)}
        </Checkbox>
      ))}
      <Button
        icon={FileCog}
        onClick={() => {
          close();
          openSetup();
        }}
      >
        {t('command.pageSetup')}
      </Button>
    </FormDialog>
  );
}
