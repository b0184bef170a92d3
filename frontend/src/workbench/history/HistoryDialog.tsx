import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary, Revision } from '@/api/types';
import { useText } from '@/i18n';
import { secondText } from '../clock';
import { confirm } from '@/ui/dialogs';
import { guard, notify } from '@/ui/notices';
import { commandContext } from '../context';
import { mayEdit } from '../rights';
import { reasonText } from '../run';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import styles from './HistoryDialog.module.css';

interface HistoryDialogProps {
  projectId: string;
  /** History of one object; null for that of the whole project. */
  object: ObjectSummary | null;
  close: () => void;
}

/** All saves, newest first; going back makes a new revision, so nothing is ever lost. */
export function HistoryDialog({ projectId, object, close }: HistoryDialogProps) {
  const t = useText();
  const path = { project_id: projectId };
  const objectPath = object && { ...path, object_id: object.id };
  const { data, error, refetch } = useQuery({
    queryKey: ['revisions', projectId, object?.id],
    queryFn: () =>
      objectPath
        ? api.get('/api/v1/projects/{project_id}/objects/{object_id}/revisions', { params: { path: objectPath } })
        : api.get('/api/v1/projects/{project_id}/revisions', { params: { path } }),
    staleTime: 0,
    gcTime: 0,
  });
  const [selected, setSelected] = useState<Revision | null>(null);
  const newest = useMemo(() => [...(data ?? [])].sort((a, b) => b.revision - a.revision), [data]);
  const allowed = mayEdit(commandContext());
  const refused = !selected
    ? t('history.chooseOne')
    : selected.revision === newest[0]?.revision
      ? t('history.isCurrent')
      : allowed === true
        ? null
        : reasonText(allowed);

  const columns = useMemo(
    (): Column<Revision>[] => [
      {
        id: 'revision',
        title: t('history.revision'),
        width: 76,
        align: 'right',
        cell: (one) => <span>{one.revision}</span>,
      },
      {
        id: 'at',
        title: t('history.at'),
        width: 175,
        cell: (one) => <span className="digits">{secondText(one.at)}</span>,
      },
      { id: 'author', title: t('history.author'), width: 100, cell: (one) => <span>{one.author}</span> },
      ...(object
        ? []
        : [
            {
              id: 'object',
              title: t('history.object'),
              width: 150,
              cell: (one: Revision) => <span>{one.object_name}</span>,
            },
          ]),
      {
        id: 'change',
        title: t('history.change'),
        width: 90,
        cell: (one) => <span>{one.change && t(`change.${one.change as 'created'}`)}</span>,
      },
      {
        id: 'comment',
        title: t('history.comment'),
        width: 120,
        grow: true,
        cell: (one) => (
          <>
            {one.revision === newest[0]?.revision && <span className={styles.now}>{t('history.now')}</span>}
            <span>{one.comment}</span>
          </>
        ),
      },
    ],
    [t, object, newest],
  );

  const revert = async () => {
    if (!selected) return;
    const sure = await confirm({
      title: t('history.revertTitle', { revision: selected.revision }),
      text: t(object ? 'history.revertObject' : 'history.revertProject', { name: object?.name ?? '' }),
      action: t('history.revert'),
    });
    if (!sure) return;
    await guard(async () => {
      const body = { revision: selected.revision };
      await (objectPath
        ? api.post('/api/v1/projects/{project_id}/objects/{object_id}/revert', { params: { path: objectPath }, body })
        : api.post('/api/v1/projects/{project_id}/revert', { params: { path }, body }));
      await queryClient.invalidateQueries({ queryKey: keys.project(projectId) });
      notify({ tone: 'ok', title: t('history.reverted', { revision: selected.revision }) });
      close();
    });
  };

  return (
    <Dialog
      title={object ? t('history.titleObject', { name: object.name }) : t('history.title')}
      width={780}
      onClose={close}
      footer={
        <>
          <Button onClick={close}>{t('action.close')}</Button>
          <Button variant="primary" disabledReason={refused} onClick={() => void revert()}>
            {t('history.revert')}
          </Button>
        </>
      }
    >
      <div className={styles.list}>
        {error ? (
          <Failed error={error} retry={() => void refetch()} />
        ) : data ? (
          <Table
            label={t('history.title')}
            items={newest}
            columns={columns}
            keyOf={(one) => String(one.revision)}
            selected={selected && String(selected.revision)}
            onSelect={setSelected}
            empty={<Empty title={t('history.empty')} />}
          />
        ) : (
          <Loading />
        )}
      </div>
    </Dialog>
  );
}
