import { useState } from 'react';
import { api } from '@/api/client';
import type { Account, Role } from '@/api/types';
import { useText } from '@/i18n';
import { FormDialog } from '@/ui/FormDialog';
import { Field, Select, TextInput } from '@/ui/Field';
import { PasswordField } from '@/ui/PasswordField';
import { useRefusal } from '@/ui/useRefusal';

const ROLES: readonly Role[] = ['viewer', 'operator', 'engineer', 'admin'];

/** A new account with its first password. */
export function NewUserDialog({ close }: { close: (account?: Account) => void }) {
  const t = useText();
  const [username, setUsername] = useState('');
  const [password, setPassword] = useState('');
  const [role, setRole] = useState<Role>('engineer');
  const [refused, ask] = useRefusal();
  const missing = username === '' || password === '' ? t('signIn.fillIn') : null;

  const create = () => ask(async () => close(await api.post('/api/v1/users', { body: { username, password, role } })));

  return (
    <FormDialog
      title={t('users.add')}
      width={400}
      onClose={() => close()}
      onSubmit={() => void create()}
      action={t('action.create')}
      disabledReason={missing}
    >
      <Field label={t('signIn.username')} error={refused}>
        {(attributes) => <TextInput {...attributes} autoComplete="off" value={username} onValue={setUsername} />}
      </Field>
      <PasswordField label={t('signIn.password')} autoComplete="new-password" value={password} onValue={setPassword} />
      <Field label={t('users.role')} hint={t(`role.${role}Text`)}>
        {(attributes) => (
          <Select<Role>
            {...attributes}
            value={role}
            choices={ROLES.map((each) => ({ value: each, text: t(`role.${each}`) }))}
            onValue={setRole}
          />
        )}
      </Field>
    </FormDialog>
  );
}
