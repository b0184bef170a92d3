import { useState, type FormEvent } from 'react';
import { api, ApiError } from '@/api/client';
import { useText } from '@/i18n';
import { explain } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Field, TextInput } from '@/ui/Field';
import { PasswordField } from '@/ui/PasswordField';
import { adoptPreferences } from '@/session/preferences';
import { setUser } from '@/session/session';
import styles from './Login.module.css';
import { LoginFrame } from './LoginFrame';

export function LoginPage() {
  const t = useText();
  const [username, setUsername] = useState('');
  const [password, setPassword] = useState('');
  const [refused, setRefused] = useState<string | null>(null);
  const [busy, setBusy] = useState(false);

  const signIn = async (event: FormEvent) => {
    event.preventDefault();
    if (busy || username === '' || password === '') return;
    setBusy(true);
    try {
      const user = await api.post('/api/v1/auth/login', { body: { username, password } });
      await adoptPreferences(user);
      setUser(user);
    } catch (error) {
      setRefused(wrong(error));
      setPassword('');
    } finally {
      setBusy(false);
    }
  };
  /** A wrong password is no signed-out session: the server's own words count here. */
  const wrong = (error: unknown) => {
    if (!(error instanceof ApiError) || error.status === 0 || error.status >= 500) return explain(error).title;
    return error.status === 401 ? t('signIn.wrong') : error.message;
  };

  return (
    <LoginFrame title={t('signIn.title')} text={t('signIn.text')}>
      <form className={styles.form} onSubmit={(event) => void signIn(event)}>
        {refused && (
          <div className={styles.error} role="alert">
            {refused}
          </div>
        )}
        <Field label={t('signIn.username')}>
          {(attributes) => (
            <TextInput
              {...attributes}
              autoFocus
              autoComplete="username"
              name="username"
              value={username}
              onValue={setUsername}
            />
          )}
        </Field>
        <PasswordField
          label={t('signIn.password')}
          autoComplete="current-password"
          name="password"
          value={password}
          onValue={setPassword}
        />
        <Button
          type="submit"
          variant="primary"
          disabledReason={username === '' || password === '' ? t('signIn.fillIn') : null}
        >
          {t('signIn.action')}
        </Button>
      </form>
    </LoginFrame>
  );
}
