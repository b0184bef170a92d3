import { useState } from 'react';
import { useText } from '@/i18n';
import { Field, Select, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { nameFault, type RecipeDefinition } from './model';

/** Stands for no recipe: a choice of the list needs a value. */
const EMPTY = '\n';

interface RecipeNameDialogProps {
  definition: RecipeDefinition;
  /** The recipe that gets another name; null: a new one. */
  own: string | null;
  initial: string;
  /** The recipe whose values a new one begins with. */
  from: string | null;
  close: (answer?: { name: string; from: string | null }) => void;
}

/** Asks for the name of a recipe, and of a new one what it begins with. */
export function RecipeNameDialog({ definition, own, initial, from, close }: RecipeNameDialogProps) {
  const t = useText();
  const [name, setName] = useState(initial);
  const [source, setSource] = useState(from ?? EMPTY);
  const fault = nameFault(definition, name, own);
  const refused = fault === null ? null : t(`recipes.fault.${fault}`, { name: name.trim() });
  return (
    <FormDialog
      title={t(own === null ? 'recipes.addRecipe' : 'recipes.renameRecipe')}
      action={t(own === null ? 'action.add' : 'recipes.rename')}
      disabledReason={refused}
      onClose={() => close()}
      onSubmit={() => close({ name, from: source === EMPTY ? null : source })}
    >
      <Field label={t('recipes.name')} error={name === '' ? null : refused}>
        {(attributes) => <TextInput {...attributes} data-autofocus value={name} onValue={setName} />}
      </Field>
      {own === null && (
        <Field label={t('recipes.beginsWith')}>
          {(attributes) => (
            <Select
              {...attributes}
              value={source}
              choices={[
                { value: EMPTY, text: t('recipes.noValues') },
                ...definition.recipes.map((recipe) => ({
                  value: recipe.name,
                  text: t('recipes.valuesOf', { name: recipe.name }),
                })),
              ]}
              onValue={setSource}
            />
          )}
        </Field>
      )}
    </FormDialog>
  );
}
