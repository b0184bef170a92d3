import { useState } from 'react';
import { api, ApiError } from '@/api/client';
import { useText } from '@/i18n';
import { explain } from '@/ui/notices';
import { PasswordField } from '@/ui/PasswordField';
import { adoptPreferences } from '@/session/preferences';
import { setUser } from '@/session/session';
import { LoginForm, UsernameField } from './LoginForm';
import { LoginFrame } from './LoginFrame';

export function LoginPage() {
  const t = useText();
  const [username, setUsername] = useState('');
  const [password, setPassword] = useState('');

  const signIn = async () => {
    try {
      const user = await api.post('/api/v1/auth/login', { body: { username, password } });
      await adoptPreferences(user);
      setUser(user);
    } catch (error) {
      setPassword('');
      throw error;
    }
  };
  /** A wrong password is no signed-out session: the server's own words count here. */
  const wrong = (error: unknown) => {
    if (!(error instanceof ApiError) || error.status === 0 || error.status >= 500) return explain(error).title;
    return error.status === 401 ? t('signIn.wrong') : error.message;
  };

  return (
    <LoginFrame title={t('signIn.title')} text={t('signIn.text')}>
      <LoginForm
        action={t('signIn.action')}
        missing={username === '' || password === '' ? t('signIn.fillIn') : null}
        send={signIn}
        refusal={wrong}
      >
        <UsernameField autoFocus value={username} onValue={setUsername} />
        <PasswordField
          label={t('signIn.password')}
          autoComplete="current-password"
          name="password"
          value={password}
          onValue={setPassword}
        />
      </LoginForm>
    </LoginFrame>
  );
}
