import { useQuery } from '@tanstack/react-query';
import { objectQuery } from '@/api/queries';
import { useText } from '@/i18n';
import type { EditorProps } from '@/project/editorProps';
import { Failed, Loading } from '@/ui/Empty';
import styles from './DataView.module.css';

/** The data of an object whose kind has no editor here, to read: a plug-in of the server may bring such kinds. */
export function DataView({ projectId, objectId }: EditorProps) {
  const t = useText();
  const { data: object, error, refetch } = useQuery(objectQuery(projectId, objectId));
  if (error) return <Failed error={error} retry={() => void refetch()} />;
  if (!object) return <Loading />;
  return (
    <div className={styles.view}>
      <p className={styles.note}>{t('editor.noneText', { kind: object.kind })}</p>
      <pre className={styles.data} aria-label={t('editor.data', { name: object.name })} tabIndex={0}>
        {JSON.stringify(object.data, null, 2)}
      </pre>
    </div>
  );
}
