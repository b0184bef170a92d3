import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ProjectSummary, RuntimeState } from '@/api/types';
import { useText } from '@/i18n';
import { Failed, Loading } from '@/ui/Empty';
import { Facts } from '@/ui/Facts';
import { Field, Select, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { useRefusal } from '@/ui/useRefusal';
import { secondText } from '../clock';
import { bytesText } from '../messages/store';

interface SourceUploadDialogProps {
  runtimes: readonly RuntimeState[];
  /** The controller that the open project leads to. */
  proposed: string | null;
  close: (project?: ProjectSummary) => void;
}

/** Reads the source that a controller keeps into a new project. */
export function SourceUploadDialog({ runtimes, proposed, close }: SourceUploadDialogProps) {
  const t = useText();
  const [runtimeId, setRuntimeId] = useState(
    runtimes.some(({ id }) => id === proposed) ? proposed! : (runtimes[0]?.id ?? ''),
  );
  const [name, setName] = useState('');
  const [refused, ask] = useRefusal();
  const path = { runtime_id: runtimeId };
  const source = useQuery({
    queryKey: ['runtimes', runtimeId, 'source'],
    queryFn: () => api.get('/api/v1/runtimes/{runtime_id}/source', { params: { path } }),
    enabled: runtimeId !== '',
    retry: false,
    staleTime: 0,
    gcTime: 0,
  });
  const info = source.data ?? null;
  const upload = async () => {
    const project = await api.post('/api/v1/runtimes/{runtime_id}/source-upload', {
      params: { path },
      body: { name: name.trim() || null },
    });
    void queryClient.invalidateQueries({ queryKey: keys.projects });
    close(project);
  };
  return (
    <FormDialog
      title={t('command.sourceUpload')}
      width={520}
      action={t('source.upload')}
      disabledReason={info ? null : t('source.none')}
      onClose={() => close()}
      onSubmit={() => void ask(upload)}
    >
      <Field label={t('source.controller')}>
        {(attributes) => (
          <Select
            {...attributes}
            value={runtimeId}
            choices={runtimes.map((runtime) => ({ value: runtime.id, text: runtime.name }))}
            onValue={setRuntimeId}
          />
        )}
      </Field>
      {source.isPending ? (
        <Loading />
      ) : source.error ? (
        <Failed error={source.error} retry={() => void source.refetch()} />
      ) : info ? (
        <Facts>
          <dt>{t('source.project')}</dt>
          <dd>{info.project}</dd>
          <dt>{t('source.by')}</dt>
          <dd>{info.stored_by}</dd>
          <dt>{t('source.at')}</dt>
          <dd className="digits">{secondText(new Date(info.stored_at_ms).toISOString())}</dd>
          <dt>{t('source.size')}</dt>
          <dd className="digits">{bytesText(info.size)}</dd>
          <dt>{t('source.state')}</dt>
          <dd>{t(info.current ? 'source.current' : 'source.other')}</dd>
        </Facts>
      ) : (
        <p>{t('source.none')}</p>
      )}
      <Field label={t('exchange.projectName')} hint={t('source.nameHint')} error={refused}>
        {(attributes) => <TextInput {...attributes} value={name} onValue={setName} />}
      </Field>
    </FormDialog>
  );
}
