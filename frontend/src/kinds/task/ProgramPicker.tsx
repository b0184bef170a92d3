import { useState, type KeyboardEvent } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { objectIcon } from '@/project/kinds';
import { search } from '@/workbench/palette/match';
import { FormDialog } from '@/ui/FormDialog';
import { Empty } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { rowAfterKey } from '@/ui/table';
import styles from './ProgramList.module.css';

interface ProgramPickerProps {
  /** The chosen one takes the place of another. */
  replacing: boolean;
  programs: readonly ObjectSummary[];
  close: (name?: string) => void;
}

const ProgramIcon = objectIcon('pou', 'program');

/** Input assistant for programs. */
export function ProgramPicker({ replacing, programs, close }: ProgramPickerProps) {
  const t = useText();
  const title = t(replacing ? 'task.replaceProgram' : 'task.addProgram');
  const [query, setQuery] = useState('');
  const [at, setAt] = useState(0);
  const hits = search(query, programs, (program) => program.name);
  const chosen = hits[at]?.entry.name;
  const onKeyDown = (event: KeyboardEvent) => {
    const next = event.key === 'Home' || event.key === 'End' ? null : rowAfterKey(event.key, at, hits.length, 10);
    if (next === null) return;
    event.preventDefault();
    setAt(next);
  };
  return (
    <FormDialog
      title={title}
      width={420}
      onClose={() => close()}
      onSubmit={() => chosen && close(chosen)}
      action={t('action.choose')}
      disabledReason={chosen ? null : t('task.chooseProgram')}
    >
      <TextInput
        data-autofocus
        value={query}
        placeholder={t('task.searchProgram')}
        aria-label={t('task.searchProgram')}
        onValue={(value) => {
          setQuery(value);
          setAt(0);
        }}
        onKeyDown={onKeyDown}
      />
      <div className={styles.list}>
        <div className={styles.table} style={{ height: 220 }} role="listbox" aria-label={title}>
          {hits.length === 0 && <Empty title={t(programs.length ? 'palette.none' : 'task.noProgramYet')} />}
          {hits.map(({ entry }, index) => (
            <div
              key={entry.id}
              role="option"
              aria-selected={index === at}
              className={styles.row}
              onMouseDown={() => setAt(index)}
              onDoubleClick={() => close(entry.name)}
            >
              <ProgramIcon />
              {entry.name}
            </div>
          ))}
        </div>
      </div>
    </FormDialog>
  );
}
