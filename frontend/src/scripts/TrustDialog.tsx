import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { listed, useText } from '@/i18n';
import { useSession } from '@/session/session';
import { FormDialog } from '@/ui/FormDialog';
import { secondText } from '@/workbench/clock';
import styles from './Scripts.module.css';

interface TrustDialogProps {
  projectId: string;
  objectId: string;
  name: string;
  text: string;
  close: (agreed?: true) => void;
}

/** Before a text runs for the first time: whose it is, what it says, and that it acts with one's own rights. */
export function TrustDialog({ projectId, objectId, name, text, close }: TrustDialogProps) {
  const t = useText();
  const user = useSession((state) => state.user);
  const revisions = useQuery({
    queryKey: ['revisions', projectId, objectId],
    queryFn: () =>
      api.get('/api/v1/projects/{project_id}/objects/{object_id}/revisions', {
        params: { path: { project_id: projectId, object_id: objectId } },
      }),
    staleTime: 0,
  });
  const authors = listed([...new Set(revisions.data?.map(({ author }) => author))]);
  const last = revisions.data?.reduce((a, b) => (a.revision > b.revision ? a : b));
  return (
    <FormDialog
      title={t('scripts.trustTitle', { name })}
      description={t('scripts.trustText', { user: user?.username ?? '', role: user ? t(`role.${user.role}`) : '' })}
      width={720}
      focusCancel
      onClose={() => close()}
      onSubmit={() => close(true)}
      action={t('scripts.runIt')}
    >
      {last && <p>{t('scripts.writtenBy', { authors, author: last.author, at: secondText(last.at) })}</p>}
      <pre className={styles.text} tabIndex={0} aria-label={t('scripts.textOf', { name })}>
        {text}
      </pre>
    </FormDialog>
  );
}
