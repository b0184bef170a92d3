import { useMemo, useState } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import type { Monaco } from '@/text/monacoLoader';
import { DiffView } from '@/compare/DiffView';
import { PartTabs } from '@/compare/PartTabs';
import styles from './DocumentBars.module.css';
import type { TextDocument } from '@/text/documents';
import type { Part } from '@/project/partUri';
import type { Resolution, TextParts } from '@/text/documentState';

export interface ConflictAnswer {
  resolution: Resolution;
  merged?: TextParts;
}

interface ConflictDialogProps {
  monaco: Monaco;
  document: TextDocument;
  close: (answer?: ConflictAnswer) => void;
}

/** Somebody else was faster: their version at the left, yours at the right, editable. Nothing is lost whatever is chosen. */
export function ConflictDialog({ monaco, document, close }: ConflictDialogProps) {
  const t = useText();
  const [{ text, theirs }] = useState(() => document.store.getState());
  const [merged, setMerged] = useState<TextParts>(text);
  const other = theirs?.parts ?? text;
  const parts = useMemo(
    () => (['declaration', 'implementation'] as const).filter((part) => other[part] !== text[part]),
    [other, text],
  );
  const [part, setPart] = useState<Part>(parts[0] ?? 'implementation');
  const edited = merged.declaration !== text.declaration || merged.implementation !== text.implementation;
  return (
    <Dialog
      title={t('doc.conflictTitle', { name: document.name })}
      description={t('doc.conflictText')}
      width={1080}
      onClose={() => close()}
      footer={
        <>
          <Button onClick={() => close()}>{t('doc.later')}</Button>
          <Button onClick={() => close({ resolution: 'theirs' })}>{t('doc.takeTheirs')}</Button>
          <Button variant={edited ? 'default' : 'primary'} onClick={() => close({ resolution: 'mine' })}>
            {t('doc.keepMine')}
          </Button>
          <Button
            variant={edited ? 'primary' : 'default'}
            disabledReason={edited ? null : t('doc.editFirst')}
            onClick={() => close({ resolution: 'merged', merged })}
          >
            {t('doc.takeMerged')}
          </Button>
        </>
      }
    >
      <div className={styles.diff}>
        <PartTabs parts={parts} part={part} onPart={setPart} />
        <DiffView
          key={part}
          monaco={monaco}
          left={other[part]}
          right={merged[part]}
          titles={[t('doc.theirs', { revision: theirs?.revision ?? 0 }), t('doc.mine')]}
          onRight={(value) => setMerged((before) => ({ ...before, [part]: value }))}
        />
      </div>
    </Dialog>
  );
}
