import { useMemo, useState, type KeyboardEvent } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Empty } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { Grid, type GridColumn } from '@/ui/grid/Grid';
import { cursorAfterKey } from '@/ui/grid/cursor';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { CATEGORIES, search, type Category } from './catalog';
import list from '@/ui/List.module.css';
import styles from './InputAssistant.module.css';
import { useCatalog } from './useCatalog';

interface InputAssistantProps {
  projectId: string;
  object: ObjectSummary | undefined;
  /** Category in front; null begins with all. */
  category?: Category | null;
  /** Text that is there already: what is searched for. */
  typed?: string;
  close: (text?: string) => void;
}

/** F2: everything that fits here, by category, found by typing. */
export function InputAssistant({ projectId, object, category = null, typed = '', close }: InputAssistantProps) {
  const t = useText();
  const [chosen, setChosen] = useState<Category | null>(category);
  const [wanted, setWanted] = useState(typed);
  const catalog = useCatalog(projectId, object);
  const entries = useMemo(() => search(catalog, chosen, wanted), [catalog, chosen, wanted]);
  const selection = useGridSelection(entries.length);
  const row = selection.cursor?.row ?? 0;
  const entry = entries[row];
  const columns: GridColumn[] = [
    { id: 'name', title: t('decl.column.name'), width: 210, grow: true, code: true },
    { id: 'detail', title: t('decl.column.type'), width: 210, grow: true, code: true },
    { id: 'group', title: t('assistant.origin'), width: 120 },
    { id: 'comment', title: t('decl.column.comment'), width: 180, grow: true },
  ];
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === 'Enter' && entry !== undefined) {
      event.preventDefault();
      close(entry.insert);
      return;
    }
    if (event.key === 'Home' || event.key === 'End' || event.key.startsWith('ArrowL') || event.key.startsWith('ArrowR'))
      return;
    const next = cursorAfterKey(event.key, event.ctrlKey, { row, column: 0 }, entries.length, 1, 10);
    if (next === null) return;
    event.preventDefault();
    selection.move(next, 'one');
  };
  return (
    <Dialog
      title={t('assistant.title')}
      width={980}
      onClose={() => close()}
      footer={
        <>
          <span className={styles.count}>{t('assistant.count', { count: entries.length })}</span>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button
            variant="primary"
            disabledReason={entry ? null : t('assistant.nothing')}
            onClick={() => close(entry?.insert)}
          >
            {t('assistant.insert')}
          </Button>
        </>
      }
    >
      <div className={styles.assistant}>
        <div
          className={styles.categories}
          role="tablist"
          aria-orientation="vertical"
          aria-label={t('assistant.categories')}
        >
          {[null, ...CATEGORIES].map((one) => (
            <button
              key={one ?? 'all'}
              type="button"
              role="tab"
              aria-selected={chosen === one}
              className={`${list.entry} ${styles.category}`}
              onClick={() => {
                setChosen(one);
                selection.clear();
              }}
            >
              {t(`assistant.category.${one ?? 'all'}`)}
            </button>
          ))}
        </div>
        <div className={styles.right}>
          <TextInput
            value={wanted}
            placeholder={t('assistant.search')}
            aria-label={t('assistant.search')}
            data-autofocus
            onValue={(value) => {
              setWanted(value);
              selection.clear();
            }}
            onKeyDown={onKeyDown}
          />
          <div className={styles.list}>
            <Grid
              label={t('assistant.title')}
              columns={columns}
              count={entries.length}
              keyOf={(index) => `${String(index)}.${entries[index]?.name ?? ''}`}
              cell={(index, column) => (
                <span>{entries[index]?.[column.id as 'name' | 'detail' | 'group' | 'comment']}</span>
              )}
              hint={(index) => entries[index]?.comment || undefined}
              selected={new Set([row])}
              cursor={selection.cursor}
              onCursor={(cursor) => selection.move(cursor, 'one')}
              onEdit={(cell) => close(entries[cell.row]?.insert)}
              empty={<Empty title={t('assistant.nothing')} text={t('assistant.nothingText')} />}
            />
          </div>
        </div>
      </div>
    </Dialog>
  );
}
