import { useState } from 'react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { notify, refusalOf } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { isComplete, NewPasswordFields, type NewPassword } from '@/ui/NewPasswordFields';
import { PasswordField } from '@/ui/PasswordField';

/** A new password for oneself. */
export function PasswordDialog({ close }: { close: () => void }) {
  const t = useText();
  const [current, setCurrent] = useState('');
  const [next, setNext] = useState<NewPassword>({ password: '', again: '' });
  const [refused, setRefused] = useState<string | null>(null);
  const missing = isComplete(next) ? null : t('firstAccount.fillIn');

  const save = async () => {
    if (missing) return;
    try {
      await api.post('/api/v1/auth/password', { body: { current, new: next.password } });
      notify({ tone: 'ok', title: t('password.changed') });
      close();
    } catch (error) {
      setRefused(refusalOf(error));
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
      <PasswordField
        label={t('password.current')}
        error={refused}
        autoComplete="current-password"
        value={current}
        onValue={setCurrent}
      />
      <NewPasswordFields label={t('password.new')} value={next} onValue={setNext} />
    </Dialog>
  );
}
