import { useState } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { TextArea } from '@/ui/Field';
import styles from './Dialogs.module.css';

interface AttributesDialogProps {
  /** One attribute or pragma a line, without braces (DECL-32). */
  value: string;
  close: (value?: string) => void;
}

export function AttributesDialog({ value, close }: AttributesDialogProps) {
  const t = useText();
  const [text, setText] = useState(value);
  const wrong = text.split('\n').find((line) => /[{}]/.test(line.replace(/'[^']*'/g, '')));
  const submit = () => {
    if (wrong === undefined) close(text);
  };
  return (
    <Dialog
      title={t('decl.attributesTitle')}
      description={t('decl.attributesText')}
      width={520}
      onClose={() => close()}
      footer={
        <>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button variant="primary" disabledReason={wrong === undefined ? null : t('decl.noBraces')} onClick={submit}>
            {t('st.ok')}
          </Button>
        </>
      }
    >
      <TextArea
        className={styles.code}
        aria-label={t('decl.attributesTitle')}
        rows={7}
        spellCheck={false}
        data-autofocus
        value={text}
        placeholder="attribute 'hide'"
        onValue={setText}
        onKeyDown={(event) => {
          if (event.key === 'Enter' && event.ctrlKey) submit();
        }}
      />
      {wrong !== undefined && (
        <div className={styles.error} role="alert">
          {t('decl.noBraces')}
        </div>
      )}
    </Dialog>
  );
}
