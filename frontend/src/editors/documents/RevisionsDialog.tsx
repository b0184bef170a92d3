import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import { api } from '@/api/client';
import { dataText } from '@/api/objects';
import { keys, queryClient } from '@/api/queries';
import type { Revision } from '@/api/types';
import { useLanguage, useText } from '@/i18n';
import { guard } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Failed, Loading } from '@/ui/Empty';
import type { Monaco } from '@/text/monacoLoader';
import { DiffView } from './DiffView';
import entries from '@/ui/List.module.css';
import styles from './DocumentBars.module.css';
import type { TextDocument } from '@/text/documents';
import type { Part } from '@/project/partUri';
import { PartTabs } from './PartTabs';

interface RevisionsDialogProps {
  monaco: Monaco;
  document: TextDocument;
  parts: readonly Part[];
  mayRevert: string | null;
  close: (answer?: true) => void;
}

/** All stored versions of an object: what each looked like beside today's text, and going back to it. */
export function RevisionsDialog({ monaco, document, parts, mayRevert, close }: RevisionsDialogProps) {
  const t = useText();
  const path = { project_id: document.projectId, object_id: document.objectId };
  const list = useQuery({
    queryKey: [...keys.object(document.projectId, document.objectId), 'revisions'],
    queryFn: () => api.get('/api/v1/projects/{project_id}/objects/{object_id}/revisions', { params: { path } }),
    staleTime: 0,
  });
  const [chosen, setChosen] = useState<number | null>(null);
  const [part, setPart] = useState<Part>(parts.includes('implementation') ? 'implementation' : 'declaration');
  const revisions = list.data ?? [];
  const current = document.store.getState();
  const shown = chosen ?? revisions[1]?.revision ?? revisions[0]?.revision ?? null;
  const old = useQuery({
    queryKey: [...keys.object(document.projectId, document.objectId), 'revisions', shown],
    queryFn: () =>
      api.get('/api/v1/projects/{project_id}/objects/{object_id}/revisions/{revision}', {
        params: { path: { ...path, revision: shown ?? 0 } },
      }),
    enabled: shown !== null,
    staleTime: Infinity,
  });
  const revert = async () => {
    if (shown === null) return;
    const done = await guard(async () => {
      await document.save();
      await api.post('/api/v1/projects/{project_id}/objects/{object_id}/revert', {
        params: { path },
        body: { revision: shown },
      });
      await queryClient.invalidateQueries({ queryKey: keys.object(document.projectId, document.objectId) });
      return true as const;
    });
    if (done) close(true);
  };
  const reason = mayRevert ?? (shown === null || shown === current.base.revision ? t('doc.currentRevision') : null);
  return (
    <Dialog
      title={t('doc.revisionsTitle', { name: document.name })}
      width={1160}
      onClose={() => close()}
      footer={
        <>
          <Button onClick={() => close()}>{t('action.close')}</Button>
          <Button variant="primary" disabledReason={reason} onClick={() => void revert()}>
            {t('doc.revert')}
          </Button>
        </>
      }
    >
      {list.isError ? (
        <Failed error={list.error} retry={() => void list.refetch()} />
      ) : (
        <div className={styles.history}>
          <RevisionList revisions={revisions} current={current.base.revision} shown={shown} onShow={setChosen} />
          <div className={styles.diff} style={{ height: 'auto', minHeight: 0 }}>
            <PartTabs parts={parts} part={part} onPart={setPart} />
            <div className={styles.sides}>
              <span>{t('doc.revision', { revision: shown ?? 0 })}</span>
              <span>{t('doc.textNow')}</span>
            </div>
            {old.data === undefined ? (
              <Loading />
            ) : (
              <DiffView monaco={monaco} left={dataText(old.data, part)} right={current.text[part]} />
            )}
          </div>
        </div>
      )}
    </Dialog>
  );
}

interface RevisionListProps {
  revisions: readonly Revision[];
  current: number;
  shown: number | null;
  onShow: (revision: number) => void;
}

function RevisionList({ revisions, current, shown, onShow }: RevisionListProps) {
  const t = useText();
  const language = useLanguage();
  const format = useMemo(
    () => new Intl.DateTimeFormat(language, { dateStyle: 'short', timeStyle: 'medium' }),
    [language],
  );
  return (
    <div className={entries.list} role="listbox" aria-label={t('doc.revisions')}>
      {revisions.map((one) => (
        <button
          key={one.revision}
          type="button"
          role="option"
          aria-selected={one.revision === shown}
          className={`${entries.entry} ${styles.revision}`}
          onClick={() => onShow(one.revision)}
        >
          <b>{t('doc.revision', { revision: one.revision })}</b>
          <time dateTime={one.at}>{format.format(new Date(one.at))}</time>
          <small>
            {[
              one.author,
              one.comment || t(one.autosave ? 'doc.autosave' : 'doc.saved'),
              one.revision === current ? t('doc.current') : '',
            ]
              .filter(Boolean)
              .join(' · ')}
          </small>
        </button>
      ))}
    </div>
  );
}
