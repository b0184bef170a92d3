import { useState } from 'react';
import { api } from '@/api/client';
import { TextImportDialog } from '@/editors/form/TextImportDialog';
import { useText } from '@/i18n';
import { Field, Select } from '@/ui/Field';
import { notify } from '@/ui/notices';
import { addRecipe, addVariables, freeName, nameFault, setValues } from './model';
import type { RecipeScene } from './scene';

/** Stands for a recipe that is not there yet. */
const ANOTHER = '\n';

/** Takes the values of a recipe file, chosen or pasted, into a recipe. */
export function ImportDialog({ scene, close }: { scene: RecipeScene; close: (answer?: true) => void }) {
  const t = useText();
  const { definition, recipe } = scene;
  const [into, setInto] = useState(recipe ?? ANOTHER);
  const take = async (text: string, fileName: string) => {
    const found = await api.post('/api/v1/projects/{project_id}/recipes/{definition_id}/file', {
      params: { path: { project_id: scene.projectId, definition_id: scene.objectId } },
      body: { text },
    });
    const wanted = fileName.split('.')[0] ?? '';
    const name =
      into !== ANOTHER
        ? into
        : nameFault(definition, wanted, null) === null
          ? wanted
          : freeName(definition, t('recipes.newName'));
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
  };
  return (
    <TextImportDialog
      texts={{
        title: t('recipes.import'),
        description: t('recipes.importText'),
        action: t('recipes.importAction'),
        empty: t('recipes.importEmpty'),
        chooseFile: t('recipes.chooseFile'),
        text: t('recipes.text'),
        tooLarge: (name) => t('recipes.fileSize', { name }),
      }}
      accept=".txtrecipe,.txt,.csv,text/plain,text/csv"
      largest={4_000_000}
      rows={10}
      placeholder={'PLC_PRG.rTemperature:=180.0\nPLC_PRG.xFan:=TRUE'}
      take={take}
      close={close}
    >
      <Field row label={t('recipes.into')}>
        {(attributes) => (
          <Select
            {...attributes}
            value={into}
            choices={[
              ...definition.recipes.map(({ name }) => ({ value: name, text: name })),
              { value: ANOTHER, text: t('recipes.intoNew') },
            ]}
            onValue={setInto}
          />
        )}
      </Field>
    </TextImportDialog>
  );
}
