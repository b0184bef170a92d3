import { useState } from 'react';
import { api, ApiError } from '@/api/client';
import { useText } from '@/i18n';
import { explain, notify } from '../notices';
import { Button } from '../ui/Button';
import { Dialog } from '../ui/Dialog';
import { Field, TextInput } from '../ui/Field';

/** A new password for oneself. */
export function PasswordDialog({ close }: { close: () => void }) {
  const t = useText();
  const [current, setCurrent] = useState('');
  const [next, setNext] = useState('');
  const [again, setAgain] = useState('');
  const [refused, setRefused] = useState<string | null>(null);
  const differs = again !== '' && again !== next ? t('firstAccount.differs') : null;
  const missing = next === '' || again !== next ? t('firstAccount.fillIn') : null;

  const save = async () => {
    if (missing) return;
    try {
      await api.post('/auth/password', { current, new: next });
      notify({ tone: 'ok', title: t('password.changed') });
      close();
    } catch (error) {
      setRefused(error instanceof ApiError && error.status !== 0 ? error.message : explain(error).title);
    }
  };

  return (
    <Dialog
      title={t('command.password')}
      description={t('password.text')}
      width={400}
      onClose={close}
      onSubmit={() => void save()}
      footer={
        <>
          <Button onClick={close}>{t('action.cancel')}</Button>
          <Button type="submit" variant="primary" disabledReason={missing}>
            {t('action.save')}
          </Button>
        </>
      }
    >
      <Field label={t('password.current')} error={refused}>
        {(attributes) => (
          <TextInput
            {...attributes}
            type="password"
            autoComplete="current-password"
            value={current}
            onValue={setCurrent}
          />
        )}
      </Field>
      <Field label={t('password.new')}>
        {(attributes) => (
          <TextInput {...attributes} type="password" autoComplete="new-password" value={next} onValue={setNext} />
        )}
      </Field>
      <Field label={t('firstAccount.again')} error={differs}>
        {(attributes) => (
          <TextInput {...attributes} type="password" autoComplete="new-password" value={again} onValue={setAgain} />
        )}
      </Field>
    </Dialog>
  );
}
