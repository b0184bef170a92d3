import { useState } from 'react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { notify, refusalOf } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { PasswordField } from '@/ui/PasswordField';

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
      await api.post('/api/v1/auth/password', { body: { current, new: next } });
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
      <PasswordField label={t('password.new')} autoComplete="new-password" value={next} onValue={setNext} />
      <PasswordField
        label={t('firstAccount.again')}
        error={differs}
        autoComplete="new-password"
        value={again}
        onValue={setAgain}
      />
    </Dialog>
  );
}
