import { Upload } from 'lucide-react';
import { useRef, useState } from 'react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Field, TextArea } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { explain, notify } from '@/ui/notices';
import type { CamEdit } from './edit';

const LARGEST = 2_000_000;

interface ImportDialogProps {
  projectId: string;
  edit: CamEdit;
  close: (answer?: true) => void;
}

/** Replaces the points of a cam by those of a text: chosen as file or pasted (CAM-80, CAM-82). */
export function ImportDialog({ projectId, edit, close }: ImportDialogProps) {
  const t = useText();
  const [text, setText] = useState('');
  const [fault, setFault] = useState<string | null>(null);
  const file = useRef<HTMLInputElement>(null);
  const read = async (given: File | undefined) => {
    if (!given) return;
    if (given.size > LARGEST) {
      setFault(t('cam.fault.fileSize', { name: given.name }));
      return;
    }
    setFault(null);
    setText(await given.text());
  };
  const take = async () => {
    try {
      const found = await api.post('/api/v1/projects/{project_id}/cams/from-text', {
        params: { path: { project_id: projectId } },
        body: { cam: edit.cam, text },
      });
      edit.change(found.cam, null);
      if (found.removed_tappets > 0)
        notify({ tone: 'info', title: t('cam.tappetsRemoved', { count: found.removed_tappets }) });
      close(true);
    } catch (error) {
      setFault(explain(error).text ?? explain(error).title);
    }
  };
  return (
    <FormDialog
      title={t('cam.import')}
      description={t('cam.importText')}
      width={560}
      action={t('cam.importAction')}
      disabledReason={text.trim() === '' ? t('cam.importEmpty') : null}
      onClose={() => close()}
      onSubmit={() => void take()}
      aside={
        <>
          <Button icon={Upload} onClick={() => file.current?.click()}>
            {t('cam.chooseFile')}
          </Button>
          <span style={{ flex: 1 }} />
        </>
      }
    >
      <input
        ref={file}
        type="file"
        accept=".txt,.csv,.cam,.dat,text/plain,text/csv"
        hidden
        aria-label={t('cam.chooseFile')}
        onChange={(event) => {
          void read(event.target.files?.[0]);
          event.target.value = '';
        }}
      />
      <Field label={t('cam.text')} error={fault}>
        {(attributes) => (
          <TextArea
            {...attributes}
            rows={12}
            className="code"
            spellCheck={false}
            placeholder={'0 0\n120 120\n360 360'}
            value={text}
            onValue={(next) => {
              setFault(null);
              setText(next);
            }}
          />
        )}
      </Field>
    </FormDialog>
  );
}
