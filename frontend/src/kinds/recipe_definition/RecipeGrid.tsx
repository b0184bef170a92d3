import { useMemo, useState, type DragEvent, type KeyboardEvent } from 'react';
import type { Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { CellInput } from '@/ui/grid/CellInput';
import { Grid, type GridColumn, type GridEditing } from '@/ui/grid/Grid';
import type { GridSelection } from '@/ui/grid/useGridSelection';
import { runCommand } from '@/workbench/run';
import {
  addVariables,
  cellFault,
  cellText,
  FACTS,
  moveVariables,
  recipeColumn,
  recipeOfColumn,
  removeVariables,
  setCell,
  type RecipeDefinition,
} from './model';
import styles from './Recipes.module.css';

const ROWS = 'application/x-recipe-rows';
const WIDTHS = { path: 240, name: 110, minimum: 84, maximum: 84, comment: 120 } as const;

interface RecipeGridProps {
  definition: RecipeDefinition;
  locked: boolean;
  /** Types by path, as far as they are known. */
  types: Readonly<Record<string, string>>;
  /** The variables beside their values in the controller; null while logged out. */
  comparison: readonly Schemas['ComparedValue'][] | null;
  selection: GridSelection;
  onRecipe: (recipe: string) => void;
  onChange: (definition: RecipeDefinition) => void;
}

/** Variables as rows, recipes as columns; a last row takes a path that is typed. */
export function RecipeGrid({ definition, locked, types, comparison, selection, onRecipe, onChange }: RecipeGridProps) {
  const t = useText();
  const [editing, setEditing] = useState<GridEditing | null>(null);
  const { variables, recipes } = definition;
  const online = comparison !== null;
  const columns = useMemo(
    (): GridColumn[] => [
      { id: 'path', title: t('recipes.column.path'), width: WIDTHS.path, grow: true, code: true },
      { id: 'type', title: t('recipes.column.type'), width: 130, code: true },
      ...FACTS.filter((fact) => fact !== 'path').map((fact): GridColumn => ({
        id: fact,
        title: t(`recipes.column.${fact}`),
        width: WIDTHS[fact],
        code: fact === 'minimum' || fact === 'maximum',
      })),
      ...(online ? [{ id: 'present', title: t('recipes.column.present'), width: 120, code: true }] : []),
      ...recipes.map((recipe): GridColumn => ({
        id: recipeColumn(recipe.name),
        title: recipe.name,
        width: 120,
        code: true,
      })),
    ],
    [t, recipes, online],
  );
  const live = useMemo(() => new Map((comparison ?? []).map((value) => [value.path, value])), [comparison]);
  const count = variables.length + (locked ? 0 : 1);
  const canEdit = (row: number, id: string) =>
    !locked && id !== 'type' && id !== 'present' && (row < variables.length || id === 'path');

  const cell = (row: number, { id }: GridColumn) => {
    const variable = variables[row];
    if (variable === undefined)
      return id === 'path' ? <span className={styles.muted}>{t('recipes.typePath')}</span> : null;
    const present = live.get(variable.path);
    if (id === 'type') return <span className={styles.muted}>{present?.type ?? types[variable.path]}</span>;
    if (id === 'present')
      return present?.error ? (
        <span className={styles.wrong}>{t('recipes.unreadable')}</span>
      ) : (
        <span>{present?.present}</span>
      );
    const recipe = recipeOfColumn(id);
    const text = cellText(definition, row, id);
    const differs = recipe !== null && present?.differing.includes(recipe) === true;
    return <span className={differs ? styles.differs : undefined}>{text}</span>;
  };
  const hint = (row: number, { id }: GridColumn) => {
    const present = live.get(variables[row]?.path ?? '');
    if (id === 'present') return present?.error ?? undefined;
    const recipe = recipeOfColumn(id);
    return recipe !== null && present?.differing.includes(recipe) ? t('recipes.differs') : undefined;
  };
  const commit = (at: GridEditing, id: string, text: string) => {
    setEditing(null);
    if (at.row < variables.length) {
      if (text !== cellText(definition, at.row, id)) onChange(setCell(definition, at.row, id, text));
    } else if (text.trim() !== '') onChange(addVariables(definition, [text], variables.length));
  };
  const onKey = (event: KeyboardEvent): boolean => {
    if (locked) return false;
    if (event.key === 'Delete') {
      const { cursor, selected } = selection;
      const column = cursor === null ? undefined : columns[cursor.column];
      if (selected.size === 1 && column !== undefined && column.id !== 'path' && canEdit(cursor!.row, column.id))
        onChange(setCell(definition, cursor!.row, column.id, ''));
      else if (selected.size > 0) onChange(removeVariables(definition, selected));
    } else if (event.key === 'Insert') void runCommand('recipes.addVariables');
    else return false;
    event.preventDefault();
    return true;
  };
  const drop = (before: number, event: DragEvent) => {
    const at = Math.min(before, variables.length);
    if (event.dataTransfer.types.includes(ROWS)) onChange(moveVariables(definition, selection.selected, at));
    else onChange(addVariables(definition, event.dataTransfer.getData('text/plain').split(/\s*\n\s*/), at));
  };
  return (
    <div className={styles.table}>
      <Grid
        label={t('kind.recipe_definition')}
        columns={columns}
        count={count}
        keyOf={(row) => variables[row]?.path ?? '\n'}
        cell={cell}
        hint={hint}
        selected={selection.selected}
        cursor={selection.cursor}
        onCursor={(place, how) => {
          selection.move(place, how);
          const recipe = recipeOfColumn(columns[place.column]?.id ?? '');
          if (recipe !== null) onRecipe(recipe);
        }}
        editing={editing}
        editor={(at) => {
          const id = columns[at.column]?.id ?? '';
          return (
            <CellInput
              label={columns[at.column]?.title ?? ''}
              value={cellText(definition, at.row, id)}
              initial={at.initial}
              check={(text) => {
                if (at.row >= variables.length && text.trim() === '') return null;
                const fault = cellFault(definition, at.row, id, text);
                return fault === null ? null : t(`recipes.fault.${fault}`, { name: text.trim() });
              }}
              onCommit={(text) => commit(at, id, text)}
              onCancel={() => setEditing(null)}
            />
          );
        }}
        onEdit={(at) => {
          if (canEdit(at.row, columns[at.column]?.id ?? '')) setEditing(at);
        }}
        editOnClick={!locked}
        onKey={onKey}
        onEmptyClick={selection.clear}
        onDragRow={
          locked
            ? undefined
            : (row, event) => {
                if (row >= variables.length) {
                  event.preventDefault();
                  return;
                }
                event.dataTransfer.setData(ROWS, '');
                const dragged = variables.filter((_, at) => selection.selected.has(at)).map(({ path }) => path);
                event.dataTransfer.setData('text/plain', dragged.join('\n'));
                event.dataTransfer.effectAllowed = 'copyMove';
              }
        }
        onDropRow={
          locked
            ? undefined
            : {
                effect: (event) =>
                  event.dataTransfer.types.includes(ROWS)
                    ? 'move'
                    : event.dataTransfer.types.includes('text/plain')
                      ? 'copy'
                      : null,
                drop,
              }
        }
      />
    </div>
  );
}
