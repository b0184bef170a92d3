import { useQuery } from '@tanstack/react-query';
import { LogOut, Trash2, UserPlus } from 'lucide-react';
import { useMemo, useState } from 'react';
import { api } from '@/api/client';
import { queryClient } from '@/api/queries';
import type { Account, Role } from '@/api/types';
import { useSession } from '@/session/session';
import { useText } from '@/i18n';
import { secondText } from '../clock';
import { confirm, openDialog } from '@/ui/dialogs';
import { guard } from '@/ui/notices';
import { Button, IconButton } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Failed, Loading } from '@/ui/Empty';
import { Select } from '@/ui/Field';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { NewUserDialog } from './NewUserDialog';

const ROLES: readonly Role[] = ['viewer', 'operator', 'engineer', 'admin'];
const KEY = ['users'];
const at = ({ id }: Account) => ({ params: { path: { user_id: id } } });

/** Accounts of this server, for administrators. */
export function UsersDialog({ close }: { close: () => void }) {
  const t = useText();
  const me = useSession((state) => state.user?.id);
  const { data, error, refetch } = useQuery({ queryKey: KEY, queryFn: () => api.get('/api/v1/users') });
  const [selected, setSelected] = useState<string | null>(null);

  const columns = useMemo((): Column<Account>[] => {
    const change = (account: Account, role: Role) =>
      void guard(async () => {
        await api.patch('/api/v1/users/{user_id}', { ...at(account), body: { role } });
        await queryClient.invalidateQueries({ queryKey: KEY });
      });
    const remove = async (account: Account) => {
      const sure = await confirm({
        title: t('users.deleteTitle', { name: account.username }),
        text: t('users.deleteText'),
        action: t('action.delete'),
        danger: true,
      });
      if (!sure) return;
      await guard(async () => {
        await api.delete('/api/v1/users/{user_id}', at(account));
        await queryClient.invalidateQueries({ queryKey: KEY });
      });
    };
    const signOut = async (account: Account) => {
      const sure = await confirm({
        title: t('users.signOutTitle', { name: account.username }),
        text: t('users.signOutText'),
        action: t('users.signOutAction'),
        danger: true,
      });
      if (sure) await guard(() => api.post('/api/v1/users/{user_id}/sign-out', at(account)));
    };
    return [
      {
        id: 'name',
        title: t('signIn.username'),
        width: 160,
        grow: true,
        sort: (account) => account.username,
        cell: (account) => <span>{account.username}</span>,
      },
      {
        id: 'role',
        title: t('users.role'),
        width: 150,
        cell: (account) => (
          <Select<Role>
            compact
            label={t('users.role')}
            value={account.role}
            disabled={account.id === me}
            choices={ROLES.map((role) => ({ value: role, text: t(`role.${role}`) }))}
            onValue={(role) => change(account, role)}
          />
        ),
      },
      {
        id: 'login',
        title: t('users.lastLogin'),
        width: 170,
        sort: (account) => account.last_login_at ?? '',
        cell: (account) => (
          <span className="digits">{account.last_login_at ? secondText(account.last_login_at) : t('users.never')}</span>
        ),
      },
      {
        id: 'signOut',
        title: '',
        width: 40,
        cell: (account) => (
          <IconButton
            small
            icon={LogOut}
            label={t('users.signOut', { name: account.username })}
            onClick={() => void signOut(account)}
          />
        ),
      },
      {
        id: 'delete',
        title: '',
        width: 40,
        cell: (account) => (
          <IconButton
            small
            icon={Trash2}
            label={t('users.delete', { name: account.username })}
            disabledReason={account.id === me ? t('users.ownAccount') : null}
            onClick={() => void remove(account)}
          />
        ),
      },
    ];
  }, [t, me]);

  const add = async () => {
    const created = await openDialog<Account>((done) => <NewUserDialog close={done} />);
    if (created) await queryClient.invalidateQueries({ queryKey: KEY });
  };

  return (
    <Dialog
      title={t('command.users')}
      description={t('users.text')}
      width={640}
      onClose={close}
      footer={
        <>
          <Button icon={UserPlus} onClick={() => void add()} style={{ marginRight: 'auto' }}>
            {t('users.add')}
          </Button>
          <Button onClick={close}>{t('action.close')}</Button>
        </>
      }
    >
      <div style={{ height: 320, border: '1px solid var(--line)', borderRadius: 'var(--radius)', overflow: 'hidden' }}>
        {error ? (
          <Failed error={error} retry={() => void refetch()} />
        ) : data ? (
          <Table
            label={t('command.users')}
            items={data}
            columns={columns}
            keyOf={(account) => account.id}
            selected={selected}
            onSelect={(account) => setSelected(account?.id ?? null)}
          />
        ) : (
          <Loading />
        )}
      </div>
    </Dialog>
  );
}
