import { useState } from 'react';
import { api } from '@/api/client';
import { queryClient } from '@/api/queries';
import { useText } from '@/i18n';
import { refusalOf } from '@/ui/notices';
import { Field, TextInput } from '@/ui/Field';
import { isComplete, NewPasswordFields, type NewPassword } from '@/ui/NewPasswordFields';
import { setUser } from '@/session/session';
import { LoginForm, UsernameField } from './LoginForm';
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
  const [chosen, setChosen] = useState<NewPassword>({ password: '', again: '' });

  const create = async () => {
    const body = { token: token.trim(), username, password: chosen.password };
    const user = await api.post('/api/v1/auth/first-account', { body });
    history.replaceState(null, '', location.pathname);
    await queryClient.invalidateQueries({ queryKey: ['auth'] });
    setUser(user);
  };

  return (
    <LoginFrame title={t('firstAccount.title')} text={t('firstAccount.text')}>
      <LoginForm
        action={t('firstAccount.action')}
        missing={token !== '' && username !== '' && isComplete(chosen) ? null : t('firstAccount.fillIn')}
        send={create}
        refusal={refusalOf}
      >
        <Field label={t('firstAccount.token')} hint={t('firstAccount.tokenHint')}>
          {(attributes) => (
            <TextInput {...attributes} className="code" autoFocus={token === ''} value={token} onValue={setToken} />
          )}
        </Field>
        <UsernameField autoFocus={token !== ''} value={username} onValue={setUsername} />
        <NewPasswordFields label={t('signIn.password')} value={chosen} onValue={setChosen} />
      </LoginForm>
    </LoginFrame>
  );
}
