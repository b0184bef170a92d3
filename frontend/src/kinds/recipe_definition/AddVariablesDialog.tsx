import { useDeferredValue, useState, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import { Empty } from '@/ui/Empty';
import { TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { cursorAfterKey } from '@/ui/grid/cursor';
import { Grid, type GridColumn } from '@/ui/grid/Grid';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { explain, notifyError } from '@/ui/notices';
import { offered, type RecipeDefinition } from './model';
import styles from './Recipes.module.css';
import { membersOf, useRecipeVariables } from './queries';

interface AddVariablesDialogProps {
  projectId: string;
  objectId: string;
  definition: RecipeDefinition;
  close: (paths?: readonly string[]) => void;
}

/** Input assistant for recipes: the elementary variables of the application, found by typing. */
export function AddVariablesDialog({ projectId, objectId, definition, close }: AddVariablesDialogProps) {
  const t = useText();
  const [query, setQuery] = useState('');
  const { data, error, isPending } = useRecipeVariables(projectId, objectId, useDeferredValue(query));
  const there = new Set(definition.variables.map(({ path }) => path.toUpperCase()));
  const free = (data?.found ?? []).filter(({ path }) => !there.has(path.toUpperCase()));
  const found = offered(free, data?.wholes ?? []);
  const selection = useGridSelection(found.length);
  const chosen = found.filter((_, at) => selection.selected.has(at));
  const [busy, setBusy] = useState(false);
  /** A whole stands for all its members. */
  const add = async () => {
    setBusy(true);
    try {
      const paths = await Promise.all(
        chosen.map(({ path, whole }) => (whole ? membersOf(projectId, objectId, path) : Promise.resolve([path]))),
      );
      close(paths.flat());
    } catch (fault) {
      notifyError(fault);
      setBusy(false);
    }
  };
  const columns: GridColumn[] = [
    { id: 'path', title: t('recipes.column.path'), width: 320, grow: true, code: true },
    { id: 'type', title: t('recipes.column.type'), width: 140, code: true },
  ];
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === 'Home' || event.key === 'End' || event.key.startsWith('ArrowL') || event.key.startsWith('ArrowR'))
      return;
    const next = cursorAfterKey(event.key, event.ctrlKey, selection.cursor, found.length, 1, 10);
    if (next === null) return;
    event.preventDefault();
    selection.move(next, event.shiftKey ? 'range' : 'one');
  };
  return (
    <FormDialog
      title={t('recipes.addVariables')}
      description={t('recipes.addVariablesText')}
      width={640}
      action={t('action.add')}
      disabledReason={busy ? t('recipes.building') : chosen.length > 0 ? null : t('recipes.chooseVariable')}
      onClose={() => close()}
      onSubmit={() => void add()}
      aside={<span className={styles.count}>{t('recipes.chosen', { count: chosen.length })}</span>}
    >
      <TextInput
        data-autofocus
        value={query}
        placeholder={t('recipes.search')}
        aria-label={t('recipes.search')}
        onValue={(text) => {
          setQuery(text);
          selection.clear();
        }}
        onKeyDown={onKeyDown}
      />
      <div className={styles.list}>
        <Grid
          label={t('recipes.addVariables')}
          columns={columns}
          count={found.length}
          keyOf={(at) => found[at]?.path ?? ''}
          cell={(at, column) => {
            const row = found[at];
            if (row === undefined) return null;
            if (column.id === 'type') return row.type;
            return row.whole ? (
              <>
                {row.path} <span className={styles.count}>{t('recipes.whole')}</span>
              </>
            ) : (
              row.path
            );
          }}
          selected={selection.selected}
          cursor={selection.cursor}
          onCursor={selection.move}
          onEdit={() => chosen.length > 0 && !busy && void add()}
          empty={
            <Empty
              title={
                error
                  ? (explain(error).text ?? explain(error).title)
                  : t(isPending ? 'recipes.building' : 'recipes.nothingFound')
              }
            />
          }
        />
      </div>
      {data?.more === true && <p className={styles.note}>{t('recipes.more', { count: data.found.length })}</p>}
    </FormDialog>
  );
}
