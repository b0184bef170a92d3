/** The values of a recipe file taken into a definition. */
import { api } from '@/api/client';
import { t } from '@/i18n';
import { notify } from '@/ui/notices';
import { addRecipe, addVariables, freeName, nameFault, setValues } from './model';
import type { RecipeScene } from './scene';

/** Takes a file into a recipe; null: into a new one, called `wanted` where that is possible. Throws what is wrong. */
export async function takeFile(scene: RecipeScene, text: string, into: string | null, wanted: string): Promise<void> {
  const { definition } = scene;
  const found = await api.post('/api/v1/projects/{project_id}/recipes/{definition_id}/file', {
    params: { path: { project_id: scene.projectId, definition_id: scene.objectId } },
    body: { text },
  });
  const fresh = nameFault(definition, wanted, null) === null ? wanted : freeName(definition, t('recipes.newName'));
  const name = into ?? fresh;
  const there = definition.recipes.some((one) => one.name === name) ? definition : addRecipe(definition, name, null);
  // A definition without variables is made of its first file.
  const first = definition.variables.length === 0;
  const filled = first ? addVariables(there, found.unknown, 0) : there;
  scene.change(setValues(filled, name, found.values));
  scene.choose(name);
  if (found.unknown.length > 0 || found.missing.length > 0)
    notify({
      tone: 'info',
      title: t('recipes.imported', { count: Object.keys(found.values).length, name }),
      text: [
        found.unknown.length > 0 && t('recipes.unknown', { paths: found.unknown.slice(0, 5).join(', ') }),
        found.missing.length > 0 && t('recipes.missing', { paths: found.missing.slice(0, 5).join(', ') }),
      ]
        .filter(Boolean)
        .join(' '),
    });
}
