import { useState } from 'react';
import { useText } from '@/i18n';
import { Field, Select } from '@/ui/Field';
import { TextImportDialog } from '@/ui/TextImportDialog';
import type { RecipeScene } from './scene';
import { takeFile } from './takeFile';

/** Stands for a recipe that is not there yet. */
const ANOTHER = '\n';

/** Takes the values of a recipe file, chosen or pasted, into a recipe. */
export function ImportDialog({ scene, close }: { scene: RecipeScene; close: (answer?: true) => void }) {
  const t = useText();
  const { definition, recipe } = scene;
  const [into, setInto] = useState(recipe ?? ANOTHER);
  const take = async (text: string, fileName: string) => {
    await takeFile(scene, text, into === ANOTHER ? null : into, fileName.split('.')[0] ?? '');
  };
  return (
    <TextImportDialog
      title={t('recipes.import')}
      texts={{
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
