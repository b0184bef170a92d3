import { useMemo, type RefObject } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import { t } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { notify, notifyError } from '@/ui/notices';
import { saveBlob } from '@/workbench/downloadFile';
import type { Enablement, Handlers, Reason } from '@/workbench/commands';
import { operator } from '@/workbench/conditions';
import { commandContext } from '@/workbench/context';
import { reasonText, runCommand } from '@/workbench/run';
import { RECIPE_ACTS, type RecipeActId, type RecipeNeed } from './acts';
import { AddVariablesDialog } from './AddVariablesDialog';
import { ControllerFilesDialog } from './ControllerFilesDialog';
import { ImportDialog } from './ImportDialog';
import { addRecipe, addVariables, freeName, removeRecipe, removeVariables, renameRecipe } from './model';
import { RecipeNameDialog } from './RecipeNameDialog';
import type { RecipeScene } from './scene';

const order = ({ projectId, objectId, recipe }: RecipeScene) => ({
  project_id: projectId,
  definition_id: objectId,
  recipe: recipe ?? '',
});

/** What is stored is what is written, read into and exported. */
const stored = () => runCommand('file.save');

async function read(scene: RecipeScene, runtimeId: string): Promise<void> {
  await stored();
  await api.post('/api/v1/runtimes/{runtime_id}/recipes/read', {
    params: { path: { runtime_id: runtimeId } },
    body: order(scene),
  });
  await queryClient.invalidateQueries({ queryKey: keys.object(scene.projectId, scene.objectId) });
  notify({ tone: 'ok', title: t('recipes.readDone', { name: scene.recipe ?? '' }) });
}

async function write(scene: RecipeScene, runtimeId: string): Promise<void> {
  await stored();
  const { values, limited } = await api.post('/api/v1/runtimes/{runtime_id}/recipes/write', {
    params: { path: { runtime_id: runtimeId } },
    body: order(scene),
  });
  notify({
    tone: limited.length > 0 ? 'warn' : 'ok',
    title: t('recipes.writeDone', { name: scene.recipe ?? '', count: values.length }),
    ...(limited.length > 0 && { text: t('recipes.limited', { paths: limited.slice(0, 5).join(', ') }) }),
  });
}

async function exportFile({ projectId, objectId, name, recipe }: RecipeScene): Promise<void> {
  await stored();
  const file = await api.download('/api/v1/projects/{project_id}/recipes/{definition_id}/{recipe}/file', {
    params: { path: { project_id: projectId, definition_id: objectId, recipe: recipe ?? '' } },
  });
  saveBlob(file, `${recipe ?? ''}.${name}.txtrecipe`);
}

const RUN: Readonly<Record<RecipeActId, (scene: RecipeScene) => Promise<void> | void>> = {
  'recipes.addVariables': async ({ projectId, objectId, definition, change, rows }) => {
    const paths = await openDialog<readonly string[]>((close) => (
      <AddVariablesDialog projectId={projectId} objectId={objectId} definition={definition} close={close} />
    ));
    const behind = rows.size > 0 ? Math.max(...rows) + 1 : definition.variables.length;
    if (paths) change(addVariables(definition, paths, behind));
  },
  'recipes.removeVariables': ({ definition, change, rows }) => change(removeVariables(definition, rows)),
  'recipes.addRecipe': async ({ definition, change, recipe, choose }) => {
    const named = await openDialog<{ name: string; from: string | null }>((close) => (
      <RecipeNameDialog
        definition={definition}
        own={null}
        initial={freeName(definition, t('recipes.newName'))}
        from={recipe}
        close={close}
      />
    ));
    if (!named) return;
    change(addRecipe(definition, named.name, named.from));
    choose(named.name.trim());
  },
  'recipes.renameRecipe': async ({ definition, change, recipe, choose }) => {
    if (recipe === null) return;
    const named = await openDialog<{ name: string; from: string | null }>((close) => (
      <RecipeNameDialog definition={definition} own={recipe} initial={recipe} from={null} close={close} />
    ));
    if (!named) return;
    change(renameRecipe(definition, recipe, named.name));
    choose(named.name.trim());
  },
  'recipes.removeRecipe': ({ definition, change, recipe, choose }) => {
    if (recipe === null) return;
    change(removeRecipe(definition, recipe));
    choose(null);
  },
  'recipes.read': (scene) => (scene.session ? read(scene, scene.session.runtimeId) : undefined),
  'recipes.write': (scene) => (scene.session ? write(scene, scene.session.runtimeId) : undefined),
  'recipes.import': (scene) => void openDialog((close) => <ImportDialog scene={scene} close={close} />),
  'recipes.export': exportFile,
  'recipes.files': async (scene) => {
    if (!scene.session) return;
    await stored();
    const { runtimeId } = scene.session;
    const fixed = operator(commandContext());
    await openDialog((close) => (
      <ControllerFilesDialog
        scene={scene}
        runtimeId={runtimeId}
        fixed={fixed === true ? null : reasonText(fixed)}
        close={close}
      />
    ));
  },
};

/** The acts of the definition that is shown, as commands find them: the same object until what is possible changes. */
export function useRecipeActs(
  latest: RefObject<RecipeScene | null>,
  possible: Readonly<Record<RecipeNeed, Enablement>>,
): Handlers {
  const { application, editing, operating, recipe, rows } = possible;
  return useMemo(() => {
    const all: Readonly<Record<RecipeNeed, Enablement>> = { application, editing, operating, recipe, rows };
    return Object.fromEntries(
      RECIPE_ACTS.map(({ id, needs }) => {
        const run = async () => {
          if (!latest.current) return;
          try {
            await RUN[id](latest.current);
          } catch (error) {
            notifyError(error);
          }
        };
        const reason = needs.map((need) => all[need]).find((one): one is Reason => one !== true);
        return [id, { run, enabled: reason ?? (true as const) }];
      }),
    );
  }, [latest, application, editing, operating, recipe, rows]);
}
