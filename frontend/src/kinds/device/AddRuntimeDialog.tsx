import { useState } from 'react';
import { api } from '@/api/client';
import type { RuntimeState } from '@/api/types';
import { useText } from '@/i18n';
import { refusalOf } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Field, TextInput } from '@/ui/Field';
import { PasswordField } from '@/ui/PasswordField';

/** Connects the server to a running soft PLC. */
export function AddRuntimeDialog({ close }: { close: (added?: RuntimeState) => void }) {
  const t = useText();
  const [name, setName] = useState('');
  const [url, setUrl] = useState('ws://');
  const [token, setToken] = useState('');
  const [refused, setRefused] = useState<string | null>(null);
  const urlFault = /^wss?:\/\/[^\s/?#]+(\/[^\s]*)?$/.test(url) ? null : t('runtime.urlFault');
  const missing = name.trim() === '' ? t('name.empty') : (urlFault ?? (token === '' ? t('runtime.tokenFault') : null));

  const add = async () => {
    if (missing) return;
    try {
      close(await api.post('/api/v1/runtimes', { body: { name: name.trim(), url, token } }));
    } catch (error) {
      setRefused(refusalOf(error));
    }
  };

  return (
    <Dialog
      title={t('runtime.add')}
      description={t('runtime.addText')}
      onClose={() => close()}
      onSubmit={() => void add()}
      footer={
        <>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button type="submit" variant="primary" disabledReason={missing}>
            {t('action.add')}
          </Button>
        </>
      }
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
    </Dialog>
  );
}
