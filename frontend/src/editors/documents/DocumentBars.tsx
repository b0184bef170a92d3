import { CloudOff, GitCompareArrows } from 'lucide-react';
import { useStore } from 'zustand';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { explain } from '@/ui/notices';
import { Button } from '@/ui/Button';
import type { Monaco } from '@/text/monacoLoader';
import { ConflictDialog, type ConflictAnswer } from './ConflictDialog';
import styles from './DocumentBars.module.css';
import type { TextDocument } from '@/text/documents';
import { phaseOf } from '@/text/documentState';

interface DocumentBarsProps {
  monaco: Monaco;
  document: TextDocument;
}

/** Above the text: what keeps it from being stored, and what can be done. Nothing while all is well. */
export function DocumentBars({ monaco, document }: DocumentBarsProps) {
  const t = useText();
  const phase = useStore(document.store, phaseOf);
  const failure = useStore(document.store, (state) => state.failure);
  if (phase === 'conflict') {
    const compare = async () => {
      const answer = await openDialog<ConflictAnswer>((close) => (
        <ConflictDialog monaco={monaco} document={document} close={close} />
      ));
      if (answer !== undefined) document.resolve(answer.resolution, answer.merged);
    };
    return (
      <div className={styles.bar} data-tone="warn" role="alert">
        <GitCompareArrows size={15} aria-hidden />
        <span className={styles.text}>{t('doc.conflict', { name: document.name })}</span>
        <Button variant="primary" onClick={() => void compare()}>
          {t('doc.compare')}
        </Button>
      </div>
    );
  }
  if (phase === 'failed') {
    const { title, text } = explain(failure);
    return (
      <div className={styles.bar} data-tone="error" role="alert">
        <CloudOff size={15} aria-hidden />
        <span className={styles.text}>
          {t('doc.notSaved')} {text ?? title}
        </span>
        <Button onClick={() => void document.save()}>{t('action.retry')}</Button>
      </div>
    );
  }
  return null;
}
