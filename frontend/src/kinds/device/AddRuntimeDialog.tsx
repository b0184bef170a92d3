import { useState } from 'react';
import { api } from '@/api/client';
import type { RuntimeState } from '@/api/types';
import { useText } from '@/i18n';
import { FormDialog } from '@/ui/FormDialog';
import { Field, TextInput } from '@/ui/Field';
import { PasswordField } from '@/ui/PasswordField';
import { useRefusal } from '@/ui/useRefusal';

/** Connects the server to a running soft PLC. */
export function AddRuntimeDialog({ close }: { close: (added?: RuntimeState) => void }) {
  const t = useText();
  const [name, setName] = useState('');
  const [url, setUrl] = useState('ws://');
  const [token, setToken] = useState('');
  const [refused, ask] = useRefusal();
  const urlFault = /^wss?:\/\/[^\s/?#]+(\/[^\s]*)?$/.test(url) ? null : t('runtime.urlFault');
  const missing = name.trim() === '' ? t('name.empty') : (urlFault ?? (token === '' ? t('runtime.tokenFault') : null));

  const add = () =>
    ask(async () => close(await api.post('/api/v1/runtimes', { body: { name: name.trim(), url, token } })));

  return (
    <FormDialog
      title={t('runtime.add')}
      description={t('runtime.addText')}
      onClose={() => close()}
      onSubmit={() => void add()}
      action={t('action.add')}
      disabledReason={missing}
    >
      <Field label={t('runtime.name')} error={refused}>
        {(attributes) => <TextInput {...attributes} data-autofocus value={name} onValue={setName} />}
      </Field>
      <Field label={t('runtime.url')} error={url === 'ws://' ? null : urlFault} hint="ws://192.168.0.10:11740">
        {(attributes) => <TextInput {...attributes} className="code" value={url} onValue={setUrl} />}
      </Field>
      <PasswordField
        label={t('runtime.token')}
        hint={t('runtime.tokenHint')}
        autoComplete="off"
        value={token}
        onValue={setToken}
      />
    </FormDialog>
  );
}
