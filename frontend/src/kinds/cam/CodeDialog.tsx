import { useEffect, useState } from 'react';
import { Copy } from 'lucide-react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Loading } from '@/ui/Empty';
import { explain } from '@/ui/notices';
import type { CamTable } from './camTable';
import styles from './Cam.module.css';

interface CodeDialogProps {
  projectId: string;
  name: string;
  cam: CamTable;
  close: () => void;
}

/** The declarations that a cam is compiled into (CAM-83, CAM-90). */
export function CodeDialog({ projectId, name, cam, close }: CodeDialogProps) {
  const t = useText();
  const [text, setText] = useState<string | null>(null);
  const [fault, setFault] = useState<string | null>(null);
  useEffect(() => {
    api
      .post('/api/v1/projects/{project_id}/cams/code', {
        params: { path: { project_id: projectId } },
        body: { cam, name },
      })
      .then((answer) => setText(answer.text))
      .catch((error: unknown) => setFault(explain(error).text ?? explain(error).title));
  }, [projectId, cam, name]);
  return (
    <Dialog
      title={t('cam.code')}
      width={760}
      onClose={close}
      footer={
        <>
          {text !== null && (
            <Button icon={Copy} onClick={() => void navigator.clipboard.writeText(text)}>
              {t('command.copy')}
            </Button>
          )}
          <Button onClick={close}>{t('action.close')}</Button>
        </>
      }
    >
      {fault !== null ? (
        <p className={styles.refused} role="alert">
          {fault}
        </p>
      ) : text === null ? (
        <Loading />
      ) : (
        <pre className={`${styles.code} code`} tabIndex={0}>
          {text}
        </pre>
      )}
    </Dialog>
  );
}
