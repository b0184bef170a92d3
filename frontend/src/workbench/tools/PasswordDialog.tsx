import { useState } from 'react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { notify } from '@/ui/notices';
import { FormDialog } from '@/ui/FormDialog';
import { isComplete, NewPasswordFields, type NewPassword } from '@/ui/NewPasswordFields';
import { PasswordField } from '@/ui/PasswordField';
import { useRefusal } from '@/ui/useRefusal';

/** A new password for oneself. */
export function PasswordDialog({ close }: { close: () => void }) {
  const t = useText();
  const [current, setCurrent] = useState('');
  const [next, setNext] = useState<NewPassword>({ password: '', again: '' });
  const [refused, ask] = useRefusal();
  const missing = isComplete(next) ? null : t('firstAccount.fillIn');

  const save = async () => {
    await api.post('/api/v1/auth/password', { body: { current, new: next.password } });
    notify({ tone: 'ok', title: t('password.changed') });
    close();
  };

  return (
    <FormDialog
      title={t('command.password')}
      description={t('password.text')}
      width={400}
      onClose={close}
      onSubmit={() => void ask(save)}
      action={t('action.save')}
      disabledReason={missing}
    >
      <PasswordField
        label={t('password.current')}
        error={refused}
        autoComplete="current-password"
        value={current}
        onValue={setCurrent}
      />
      <NewPasswordFields label={t('password.new')} value={next} onValue={setNext} />
    </FormDialog>
  );
}
