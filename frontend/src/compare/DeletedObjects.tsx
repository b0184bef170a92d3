import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { ObjectIcon } from '@/project/ObjectIcon';
import { displayName, displayPath, displayPlace } from '@/project/objectName';
import { Button } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { guard, notify } from '@/ui/notices';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { secondText } from '@/workbench/clock';
import { commandContext } from '@/workbench/context';
import { mayEdit } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import { revealInTree } from '@/workbench/tree/state';
import styles from './compare.module.css';
import { Footer } from './Footer';

type Deleted = Schemas['DeletedObject'];

/** What was deleted and can come back, latest first. */
export function DeletedObjects({ projectId, foot }: { projectId: string; foot: HTMLDivElement | null }) {
  const t = useText();
  const path = { project_id: projectId };
  const { data, error, refetch } = useQuery({
    queryKey: ['deleted', projectId],
    queryFn: () => api.get('/api/v1/projects/{project_id}/deleted-objects', { params: { path } }),
    staleTime: 0,
    gcTime: 0,
  });
  const [chosen, setChosen] = useState<string | null>(null);
  const selected = data?.find((one) => one.id === chosen);
  const allowed = mayEdit(commandContext());
  const refused = !selected ? t('deleted.chooseOne') : allowed === true ? null : reasonText(allowed);
  const columns = useMemo(
    (): Column<Deleted>[] => [
      {
        id: 'name',
        title: t('deleted.name'),
        width: 220,
        sort: displayName,
        cell: (one) => (
          <>
            <ObjectIcon kind={one.kind} subkind={one.subkind} name={one.name} />
            <span>{displayName(one)}</span>
          </>
        ),
      },
      {
        id: 'path',
        title: t('deleted.where'),
        width: 200,
        grow: true,
        sort: (one) => one.path,
        hint: (one) => displayPath(one.path),
        cell: (one) => <span>{displayPlace(one.path)}</span>,
      },
      {
        id: 'below',
        title: t('deleted.below'),
        width: 110,
        align: 'right',
        sort: (one) => one.below,
        cell: (one) => <span>{one.below || ''}</span>,
      },
      {
        id: 'at',
        title: t('history.at'),
        width: 160,
        sort: (one) => one.at,
        cell: (one) => <span className="digits">{secondText(one.at)}</span>,
      },
      {
        id: 'author',
        title: t('history.author'),
        width: 110,
        sort: (one) => one.author,
        cell: (one) => <span>{one.author}</span>,
      },
    ],
    [t],
  );
  const restore = (one: Deleted) =>
    guard(async () => {
      await api.post('/api/v1/projects/{project_id}/objects/{object_id}/revert', {
        params: { path: { ...path, object_id: one.id } },
        body: { revision: one.revision },
      });
      await queryClient.invalidateQueries({ queryKey: keys.project(projectId) });
      await refetch();
      revealInTree(one.id);
      notify({ tone: 'ok', title: t('deleted.restored', { name: displayName(one) }) });
    });
  return (
    <div className={styles.deleted}>
      {error ? (
        <Failed error={error} retry={() => void refetch()} />
      ) : data ? (
        <Table
          label={t('history.page.deleted')}
          items={data}
          columns={columns}
          keyOf={(one) => one.id}
          selected={chosen}
          onSelect={(one) => setChosen(one?.id ?? null)}
          onOpen={(one) => allowed === true && void restore(one)}
          empty={<Empty title={t('deleted.empty')} text={t('deleted.emptyText')} />}
        />
      ) : (
        <Loading />
      )}
      <Footer place={foot}>
        <Button variant="primary" disabledReason={refused} onClick={() => selected && void restore(selected)}>
          {t('deleted.restore')}
        </Button>
      </Footer>
    </div>
  );
}
