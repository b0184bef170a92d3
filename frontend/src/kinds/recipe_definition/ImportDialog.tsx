import { Upload } from 'lucide-react';
import { useRef, useState } from 'react';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Field, Select, TextArea } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { explain, notify } from '@/ui/notices';
import { addRecipe, addVariables, freeName, nameFault, setValues } from './model';
import type { RecipeScene } from './scene';

const LARGEST = 4_000_000;
/** Stands for a recipe that is not there yet. */
const ANOTHER = '\n';

/** Takes the values of a recipe file, chosen or pasted, into a recipe. */
export function ImportDialog({ scene, close }: { scene: RecipeScene; close: (answer?: true) => void }) {
  const t = useText();
  const { definition, recipe } = scene;
  const [text, setText] = useState('');
  const [into, setInto] = useState(recipe ?? ANOTHER);
  const [fault, setFault] = useState<string | null>(null);
  const [fileName, setFileName] = useState('');
  const file = useRef<HTMLInputElement>(null);
  const pick = async (given: File | undefined) => {
    if (!given) return;
    if (given.size > LARGEST) {
      setFault(t('recipes.fileSize', { name: given.name }));
      return;
    }
    setFault(null);
    setFileName(given.name);
    setText(await given.text());
  };
  const take = async () => {
    try {
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
      const there = definition.recipes.some((one) => one.name === name)
        ? definition
        : addRecipe(definition, name, null);
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
      close(true);
    } catch (error) {
      setFault(explain(error).text ?? explain(error).title);
    }
  };
  return (
    <FormDialog
      title={t('recipes.import')}
      description={t('recipes.importText')}
      width={560}
      action={t('recipes.importAction')}
      disabledReason={text.trim() === '' ? t('recipes.importEmpty') : null}
      onClose={() => close()}
      onSubmit={() => void take()}
      aside={
        <>
          <Button icon={Upload} onClick={() => file.current?.click()}>
            {t('recipes.chooseFile')}
          </Button>
          <span style={{ flex: 1 }} />
        </>
      }
    >
      <input
        ref={file}
        type="file"
        accept=".txtrecipe,.txt,.csv,text/plain,text/csv"
        hidden
        aria-label={t('recipes.chooseFile')}
        onChange={(event) => {
          void pick(event.target.files?.[0]);
          event.target.value = '';
        }}
      />
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
      <Field label={t('recipes.text')} error={fault}>
        {(attributes) => (
          <TextArea
            {...attributes}
            rows={10}
            className="code"
            spellCheck={false}
            placeholder={'PLC_PRG.rTemperature:=180.0\nPLC_PRG.xFan:=TRUE'}
            value={text}
            onValue={(next) => {
              setFault(null);
              setText(next);
            }}
          />
        )}
      </Field>
    </FormDialog>
  );
}
