import { useState } from 'react';
import { DiffView } from '@/compare/DiffView';
import { PartTabs } from '@/compare/PartTabs';
import { listed, useText } from '@/i18n';
import { FormDialog } from '@/ui/FormDialog';
import type { Part } from '@/project/partUri';
import type { Monaco } from '@/text/monacoLoader';
import type { ComparedObject } from '@/workbench/exchange/comparison';
import styles from './DocumentBars.module.css';

interface CompareImportDialogProps {
  monaco: Monaco;
  compared: ComparedObject;
  close: (texts?: Record<string, string>) => void;
}

/** The object of the project at the left, both versions joined at the right, to be edited. */
export function CompareImportDialog({ monaco, compared, close }: CompareImportDialogProps) {
  const t = useText();
  const { name, comparison } = compared;
  const shown = comparison.texts.filter(({ ours, theirs }) => ours !== theirs);
  const [texts, setTexts] = useState(
    () => compared.texts ?? Object.fromEntries(comparison.texts.map(({ field, merged }) => [field, merged])),
  );
  const [part, setPart] = useState(shown[0]?.field ?? '');
  const text = shown.find(({ field }) => field === part);
  const places = text?.conflicts.length ?? 0;
  const reason = comparison.fields.length ? t('exchange.fieldsDiffer', { fields: listed(comparison.fields) }) : null;
  return (
    <FormDialog
      title={t('exchange.compareTitle', { name })}
      description={t(comparison.ancestor ? 'exchange.withAncestor' : 'exchange.withoutAncestor')}
      width={1080}
      action={t('exchange.takeJoined')}
      disabledReason={reason}
      onClose={() => close()}
      onSubmit={() => close(texts)}
    >
      <div className={styles.diff}>
        <PartTabs parts={shown.map(({ field }) => field as Part)} part={part as Part} onPart={setPart} />
        {reason && <div role="alert">{reason}</div>}
        {text && (
          <DiffView
            key={part}
            monaco={monaco}
            left={text.ours}
            right={texts[part] ?? text.merged}
            titles={[
              t('exchange.ours'),
              places ? t('exchange.joinedConflicts', { count: places }) : t('exchange.joinedSide'),
            ]}
            onRight={(value) => setTexts((before) => ({ ...before, [part]: value }))}
          />
        )}
      </div>
    </FormDialog>
  );
}
