import { Zap } from 'lucide-react';
import { useEffect, useRef } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { keysText } from '@/workbench/keys';
import bars from '../documents/DocumentBars.module.css';
import { answerEdit, useOnlineEdit } from './onlineEdit';
import styles from './OnlineEditBar.module.css';

/** Above a text that runs: asks whether it shall be edited, and shows what has been typed meanwhile. */
export function OnlineEditBar({ object }: { object: ObjectSummary }) {
  const t = useText();
  const question = useOnlineEdit((state) => state.questions.get(object.id));
  const bar = useRef<HTMLDivElement>(null);
  const asked = question !== undefined;

  // The keys of the answer act in the whole panel, wherever in it the focus is.
  useEffect(() => {
    const panel = bar.current?.parentElement;
    if (!asked || panel == null) return;
    const onKey = (event: KeyboardEvent) => {
      const agreed = event.key === 'Enter' && (event.ctrlKey || event.metaKey);
      if (!agreed && event.key !== 'Escape') return;
      event.preventDefault();
      event.stopImmediatePropagation();
      answerEdit(object.id, agreed);
    };
    panel.addEventListener('keydown', onKey, true);
    return () => panel.removeEventListener('keydown', onKey, true);
  }, [asked, object.id]);

  if (!asked) return null;
  const typed = [...question.kept.values()].join(' ').replaceAll('\n', '\u21b5');
  return (
    <div ref={bar} className={bars.bar} data-tone="warn" role="alert">
      <Zap size={15} aria-hidden />
      <span className={bars.text}>
        {t('st.unlockTitle', { name: object.name })} <span className={styles.more}>{t('st.unlockText')}</span>
        {typed !== '' && (
          <span className={styles.typed}>
            {t('st.unlockTyped')} <code>{typed}</code>
          </span>
        )}
      </span>
      <Button variant="primary" onClick={() => answerEdit(object.id, true)}>
        {t('st.unlock')} <kbd className={styles.key}>{keysText('Ctrl+Enter')}</kbd>
      </Button>
      <Button onClick={() => answerEdit(object.id, false)}>
        {t('action.cancel')} <kbd className={styles.key}>{keysText('Esc')}</kbd>
      </Button>
    </div>
  );
}
