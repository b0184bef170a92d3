import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary, Revision } from '@/api/types';
import { useText } from '@/i18n';
import { displayName } from '@/project/objectName';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { confirm } from '@/ui/dialogs';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Select } from '@/ui/Field';
import { guard, notify } from '@/ui/notices';
import { commandContext } from '@/workbench/context';
import { mayEdit } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import { sideOf, type Comparison, type Ignoring } from './comparison';
import styles from './compare.module.css';
import { ComparisonView } from './ComparisonView';
import { DeletedObjects } from './DeletedObjects';
import { Footer } from './Footer';
import { RevisionList } from './RevisionList';
import { useDifferences, useRevisions } from './useComparison';
import { useMerge } from './useMerge';

interface HistoryDialogProps {
  projectId: string;
  /** History of one object with what is below it; null for that of the whole project. */
  object: ObjectSummary | null;
  /** Begins with what was deleted. */
  deleted?: boolean;
  close: () => void;
}

type Page = 'revisions' | 'deleted';

/** What was saved when and by whom, each beside the present state or another one; going back makes a new revision. */
export function HistoryDialog({ projectId, object, deleted = false, close }: HistoryDialogProps) {
  const t = useText();
  const [page, setPage] = useState<Page>(deleted ? 'deleted' : 'revisions');
  const [foot, setFoot] = useState<HTMLDivElement | null>(null);
  return (
    <Dialog
      title={object ? t('history.titleObject', { name: displayName(object) }) : t('history.title')}
      width={1500}
      onClose={close}
      footer={
        <>
          <div ref={setFoot} className={styles.foot} />
          <Button onClick={close}>{t('action.close')}</Button>
        </>
      }
    >
      {!object && (
        <div className={styles.tabs} role="tablist">
          {(['revisions', 'deleted'] as const).map((one) => (
            <button
              key={one}
              type="button"
              role="tab"
              aria-selected={one === page}
              className={styles.tab}
              onClick={() => setPage(one)}
            >
              {t(`history.page.${one}`)}
            </button>
          ))}
        </div>
      )}
      {page === 'deleted' ? (
        <DeletedObjects projectId={projectId} foot={foot} />
      ) : (
        <Revisions projectId={projectId} object={object} foot={foot} />
      )}
    </Dialog>
  );
}

const NOW = 'now';
const BEFORE = 'before';

/** The two revisions of the project to compare, from the one in hand and what it is compared with; null at the first. */
function compared(selected: Revision, other: string): { old: number; now: number | null } | null {
  const number = selected.project_revision;
  if (other === NOW) return { old: number, now: null };
  if (other === BEFORE) return number > 1 ? { old: number - 1, now: number } : null;
  const [old, now] = [number, Number(other)].sort((a, b) => a - b) as [number, number];
  return { old, now };
}

function Revisions({ projectId, object, foot }: Omit<HistoryDialogProps, 'close'> & { foot: HTMLDivElement | null }) {
  const t = useText();
  const path = { project_id: projectId };
  const objectPath = object && { ...path, object_id: object.id };
  const list = useQuery({
    queryKey: ['revisions', projectId, object?.id],
    queryFn: () =>
      objectPath
        ? api.get('/api/v1/projects/{project_id}/objects/{object_id}/revisions', { params: { path: objectPath } })
        : api.get('/api/v1/projects/{project_id}/revisions', { params: { path, query: { limit: 1000 } } }),
    staleTime: 0,
    gcTime: 0,
  });
  const newest = useMemo(() => [...(list.data ?? [])].sort((a, b) => b.revision - a.revision), [list.data]);
  const [chosen, setChosen] = useState<number | null>(null);
  const [against, setOther] = useState(NOW);
  const [ignoring, setIgnoring] = useState<Ignoring>({ white_space: false, comments: false, pragmas: false });
  const selected = newest.find((one) => one.revision === chosen) ?? newest[1] ?? newest[0];
  // A revision beside itself would say nothing.
  const other = against === String(selected?.project_revision) ? NOW : against;
  const revisions = selected ? compared(selected, other) : null;
  const opened = useRevisions(projectId, revisions);
  const query = useDifferences(projectId, opened.data, ignoring);
  const found = opened.data && (query.data?.id === opened.data.id ? query.data : opened.data);
  const comparison = useMemo(() => (found && object ? ofObject(found, object.id) : found), [found, object]);
  const renew = () => Promise.all([list.refetch(), query.refetch()]);
  const { choices, choose, refused, count, merge } = useMerge(projectId, comparison, renew);
  const allowed = mayEdit(commandContext());
  const noWay = !selected
    ? t('history.chooseOne')
    : selected.revision === newest[0]?.revision
      ? t('history.isCurrent')
      : allowed === true
        ? null
        : reasonText(allowed);

  const revert = async () => {
    if (!selected) return;
    const sure = await confirm({
      title: t('history.revertTitle', { revision: selected.revision }),
      text: t(object ? 'history.revertObject' : 'history.revertProject', { name: object ? displayName(object) : '' }),
      action: t('history.revert'),
    });
    if (!sure) return;
    await guard(async () => {
      const body = { revision: selected.revision };
      await (objectPath
        ? api.post('/api/v1/projects/{project_id}/objects/{object_id}/revert', { params: { path: objectPath }, body })
        : api.post('/api/v1/projects/{project_id}/revert', { params: { path }, body }));
      await queryClient.invalidateQueries({ queryKey: keys.project(projectId) });
      await renew();
      notify({ tone: 'ok', title: t('history.reverted', { revision: selected.revision }) });
    });
  };

  if (list.error) return <Failed error={list.error} retry={() => void list.refetch()} />;
  if (!list.data) return <Loading />;
  if (!selected) return <Empty title={t('history.empty')} />;
  const title = (revision: string | number) => t('history.titleRevision', { revision });
  const right =
    revisions?.now == null ? t('history.present') : title(other === BEFORE ? selected.revision : revisions.now);
  const left = revisions === null ? '' : title(other === NOW ? selected.revision : revisions.old);
  return (
    <div className={styles.history}>
      <div className={styles.revisions}>
        <RevisionList revisions={newest} selected={selected.revision} select={setChosen} ofProject={object === null} />
        <label className={styles.with}>
          <span>{t('history.comparedWith')}</span>
          <Select
            label={t('history.comparedWith')}
            value={other}
            onValue={setOther}
            choices={[
              { value: NOW, text: t('history.present') },
              { value: BEFORE, text: t('history.before') },
              ...newest
                .filter((one) => one !== selected)
                .map((one) => ({ value: String(one.project_revision), text: title(one.revision) })),
            ]}
          />
        </label>
      </div>
      <div className={styles.seen}>
        {opened.error ? (
          <Failed error={opened.error} retry={() => void opened.refetch()} />
        ) : revisions === null ? (
          <Empty title={t('history.first')} />
        ) : comparison ? (
          <ComparisonView
            projectId={projectId}
            comparison={comparison}
            titles={[left, right]}
            ignoring={ignoring}
            ignore={setIgnoring}
            choices={choices}
            choose={choose}
          />
        ) : (
          <Loading />
        )}
      </div>
      <Footer place={foot}>
        <Button disabledReason={refused} onClick={() => void merge()}>
          {count > 0 ? t('compare.takeSome', { count }) : t('compare.take')}
        </Button>
        <Button variant="primary" disabledReason={noWay} onClick={() => void revert()}>
          {t('history.revert')}
        </Button>
      </Footer>
    </div>
  );
}

/** The part of a comparison that concerns an object and what is below it. */
function ofObject(comparison: Comparison, objectId: string): Comparison {
  const own = comparison.differences.find((one) => one.new?.id === objectId || one.old?.id === objectId);
  const tops = [own?.new?.path, own?.old?.path];
  const below = (path: string | undefined) => tops.some((top) => top !== undefined && path?.startsWith(`${top}/`));
  return {
    ...comparison,
    differences: comparison.differences.filter((one) => one === own || below(sideOf(one).path) || below(one.old?.path)),
  };
}
