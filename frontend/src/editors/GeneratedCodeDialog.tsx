import { useEffect, useState } from 'react';
import { Copy } from 'lucide-react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Loading } from '@/ui/Empty';
import { explain } from '@/ui/notices';
import styles from './GeneratedCodeDialog.module.css';

interface GeneratedCodeDialogProps {
  title: string;
  /** Asks the server for the text; always the same function. */
  ask: () => Promise<string>;
  close: () => void;
}

/** The ST that is made of an object, to read and to copy. */
export function GeneratedCodeDialog({ title, ask, close }: GeneratedCodeDialogProps) {
  const t = useText();
  const [text, setText] = useState<string | null>(null);
  const [fault, setFault] = useState<string | null>(null);
  useEffect(() => {
    ask()
      .then(setText)
      .catch((error: unknown) => setFault(explain(error).text ?? explain(error).title));
  }, [ask]);
  return (
    <Dialog
      title={title}
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
