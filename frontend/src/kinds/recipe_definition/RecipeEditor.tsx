import { Plus } from 'lucide-react';
import { useEffect, useRef, useState } from 'react';
import { ofKind } from '@/api/objects';
import { useObject } from '@/api/queries';
import { useText } from '@/i18n';
import type { EditorProps } from '@/project/editorProps';
import { useDraft } from '@/editors/form/useDraft';
import { LostBar } from '@/online/LostBar';
import { useObjectSession } from '@/online/useObjectSession';
import { Button } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { useGridSelection } from '@/ui/grid/useGridSelection';
import { explain } from '@/ui/notices';
import type { Enablement } from '@/workbench/commands';
import { atLeast, mayChangeText } from '@/workbench/rights';
import { runCommand } from '@/workbench/run';
import { useCommandContext } from '@/workbench/useCommandContext';
import { useComparison, useRecipeVariables } from './queries';
import { RecipeGrid } from './RecipeGrid';
import { RecipeToolbar } from './RecipeToolbar';
import styles from './Recipes.module.css';
import type { RecipeScene } from './scene';
import { useRecipeActs } from './useRecipeActs';

const always = () => true;
/** Fits no variable: only the types of those that the definition has are wanted. */
const NO_OTHERS = '\u2205';

/** A recipe definition: its variables, its recipes, and what the controller has. */
export default function RecipeEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const { data: object } = useObject(projectId, objectId, ofKind('recipe_definition'));
  const session = useObjectSession(projectId, object);
  const context = useCommandContext();
  const [chosen, setChosen] = useState<string | null>(null);
  const scene = useRef<RecipeScene | null>(null);
  const present = object?.data;
  const selection = useGridSelection(present?.variables.length ?? 0);
  const [recipe, setShown] = useState<string | null>(null);
  const application: Enablement =
    session === null ? 'reason.notLoggedIn' : session.lostSince !== null ? 'reason.connectionLost' : true;
  const acts = useRecipeActs(scene, {
    application,
    editing: mayChangeText(context),
    operating: atLeast(context.role, 'operator') ? true : 'reason.operator',
    recipe: recipe === null ? 'recipes.chooseRecipe' : true,
    rows: selection.selected.size > 0 ? true : 'reason.nothingSelected',
  });
  const draft = useDraft(panelId, projectId, objectId, ofKind('recipe_definition'), always, acts, mayChangeText);
  const definition = draft.data;
  const shown =
    definition?.recipes.find(({ name }) => name === chosen)?.name ??
    (definition?.recipes.length === 1 ? (definition.recipes[0]?.name ?? null) : null);
  if (shown !== recipe) setShown(shown);
  const runtimeId = application === true ? (session?.runtimeId ?? null) : null;
  const comparison = useComparison(runtimeId, projectId, objectId, draft.object?.revision ?? 0);
  const types = useRecipeVariables(projectId, objectId, NO_OTHERS, draft.object?.revision);
  const { change } = draft;
  const name = draft.object?.name ?? '';
  const { selected } = selection;
  useEffect(() => {
    scene.current = definition
      ? {
          projectId,
          objectId,
          name,
          definition,
          change,
          recipe: shown,
          choose: setChosen,
          rows: selected,
          session,
        }
      : null;
  }, [projectId, objectId, name, definition, change, shown, selected, session]);
  if (draft.error && !draft.object) return <Failed error={draft.error} />;
  if (definition === undefined || !draft.object) return <Loading />;
  const locked = draft.readOnly !== null;
  const empty = definition.variables.length === 0 && definition.recipes.length === 0;
  return (
    <div className={styles.page}>
      <RecipeToolbar acts={acts} definition={definition} recipe={shown} onRecipe={setChosen} />
      <LostBar session={session} />
      {draft.readOnly && <div className={styles.banner}>{draft.readOnly}</div>}
      {draft.refused && (
        <div className={styles.banner} data-tone="error" role="alert">
          {draft.refused}
        </div>
      )}
      {comparison.error && runtimeId !== null && (
        <div className={styles.banner} data-tone="error" role="status">
          {explain(comparison.error).text ?? explain(comparison.error).title}
        </div>
      )}
      {empty && (
        <Empty title={t('recipes.empty')} text={t('recipes.emptyText')}>
          <Button
            variant="primary"
            icon={Plus}
            disabledReason={draft.readOnly}
            onClick={() => void runCommand('recipes.addVariables')}
          >
            {t('recipes.addVariables')}
          </Button>
        </Empty>
      )}
      <RecipeGrid
        definition={definition}
        locked={locked}
        types={types.data?.types ?? {}}
        comparison={runtimeId === null ? null : (comparison.data?.values ?? [])}
        selection={selection}
        onRecipe={setChosen}
        onChange={change}
      />
    </div>
  );
}
