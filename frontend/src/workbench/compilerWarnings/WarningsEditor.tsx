import { useState } from 'react';
import type { CompilerWarning } from '@/api/types';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Checkbox } from '@/ui/Field';
import { FilterInput } from '@/ui/Filter';
import { messageText } from '../staticAnalysis/model';
import { matching, switched } from './model';
import styles from './CompilerWarnings.module.css';

interface WarningsEditorProps {
  warnings: readonly CompilerWarning[];
  /** Codes that are not reported. */
  off: readonly string[];
  /** Why nothing can be changed, or null. */
  readOnly: string | null;
  change: (off: string[]) => void;
}

/** All warnings of the compiler, each with a box: ticked ones are reported. */
export function WarningsEditor({ warnings, off, readOnly, change }: WarningsEditorProps) {
  const t = useText();
  const [search, setSearch] = useState('');
  const shown = matching(warnings, search);
  const codes = shown.map(({ code }) => code);
  const hidden = new Set(off);
  const on = warnings.filter(({ code }) => !hidden.has(code)).length;
  return (
    <>
      <div className={styles.bar}>
        <FilterInput className={styles.search} label={t('warnings.search')} value={search} onValue={setSearch} />
        <span className={styles.muted}>{t('analysis.on', { on, all: warnings.length })}</span>
        <Button disabledReason={readOnly} onClick={() => change(switched(off, codes, true))}>
          {t('analysis.allOn')}
        </Button>
        <Button disabledReason={readOnly} onClick={() => change(switched(off, codes, false))}>
          {t('analysis.allOff')}
        </Button>
      </div>
      <div className={styles.list} role="group" aria-label={t('warnings.title')}>
        {shown.length === 0 && <Empty title={t('tree.nothingFound', { text: search.trim() })} />}
        {shown.map(({ code, numbers, message, advice }) => (
          <div key={code} className={styles.warning}>
            <Checkbox
              checked={!hidden.has(code)}
              disabled={readOnly !== null}
              onChecked={(checked) => change(switched(off, [code], checked))}
            >
              <span className="code">{code}</span> {messageText(message)}
            </Checkbox>
            <div className={styles.muted}>{[numbers.join(', '), messageText(advice)].filter(Boolean).join(' · ')}</div>
          </div>
        ))}
      </div>
    </>
  );
}
