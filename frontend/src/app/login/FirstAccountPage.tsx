import { useState, type FormEvent } from 'react';
import { api } from '@/api/client';
import { queryClient } from '@/api/queries';
import { useText } from '@/i18n';
import { refusalOf } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Field, TextInput } from '@/ui/Field';
import { PasswordField } from '@/ui/PasswordField';
import { setUser } from '@/session/session';
import styles from './Login.module.css';
import { LoginFrame } from './LoginFrame';

/** The token of a link that the console printed: `/?token=...`. */
function tokenOfAddress(): string {
  return new URLSearchParams(location.search).get('token') ?? '';
}

/** The first administrator of a new installation, allowed by the one-time token on the server's console. */
export function FirstAccountPage() {
  const t = useText();
  const [token, setToken] = useState(tokenOfAddress);
  const [username, setUsername] = useState('');
  const [password, setPassword] = useState('');
  const [again, setAgain] = useState('');
  const [refused, setRefused] = useState<string | null>(null);
  const [busy, setBusy] = useState(false);
  const differs = again !== '' && again !== password ? t('firstAccount.differs') : null;
  const missing =
    token === '' || username === '' || password === '' || again !== password ? t('firstAccount.fillIn') : null;

  const create = async (event: FormEvent) => {
    event.preventDefault();
    if (busy || missing) return;
    setBusy(true);
    try {
      const user = await api.post('/api/v1/auth/first-account', { body: { token: token.trim(), username, password } });
      history.replaceState(null, '', location.pathname);
      await queryClient.invalidateQueries({ queryKey: ['auth'] });
      setUser(user);
    } catch (error) {
      setRefused(refusalOf(error));
    } finally {
      setBusy(false);
    }
  };

  return (
    <LoginFrame title={t('firstAccount.title')} text={t('firstAccount.text')}>
      <form className={styles.form} onSubmit={(event) => void create(event)}>
        {refused && (
          <div className={styles.error} role="alert">
            {refused}
          </div>
        )}
        <Field label={t('firstAccount.token')} hint={t('firstAccount.tokenHint')}>
          {(attributes) => (
            <TextInput {...attributes} className="code" autoFocus={token === ''} value={token} onValue={setToken} />
          )}
        </Field>
        <Field label={t('signIn.username')}>
          {(attributes) => (
            <TextInput
              {...attributes}
              autoFocus={token !== ''}
              autoComplete="username"
              name="username"
              value={username}
              onValue={setUsername}
            />
          )}
        </Field>
        <PasswordField
          label={t('signIn.password')}
          autoComplete="new-password"
          value={password}
          onValue={setPassword}
        />
        <PasswordField
          label={t('firstAccount.again')}
          error={differs}
          autoComplete="new-password"
          value={again}
          onValue={setAgain}
        />
        <Button type="submit" variant="primary" disabledReason={missing}>
          {t('firstAccount.action')}
        </Button>
      </form>
    </LoginFrame>
  );
}
