import { useState } from 'react';
import { useText } from '@/i18n';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { fits, valueOf, withValues, type Instance, type PathBlock } from './blocks';
import own from './CncSettings.module.css';

interface ParameterDialogProps {
  block: PathBlock;
  instance: Instance;
  close: (answer?: Instance) => void;
}

/** The inputs of an instance of a preprocessing block (CNCS-09). */
export function ParameterDialog({ block, instance, close }: ParameterDialogProps) {
  const t = useText();
  const [values, setValues] = useState<Readonly<Record<string, string>>>(() =>
    Object.fromEntries(block.parameters.map((one) => [one.name, valueOf(instance, one)])),
  );
  const wrong = block.parameters.filter((one) => !fits(values[one.name]!, one));
  const set = (name: string) => (value: string) => setValues({ ...values, [name]: value });
  return (
    <FormDialog
      title={t('cncSettings.parametersOf', { block: block.name })}
      description={block.comment}
      width={640}
      action={t('properties.apply')}
      disabledReason={wrong.length > 0 ? t('cncSettings.noValue', { name: wrong[0]!.name }) : null}
      onClose={() => close()}
      onSubmit={() => close(withValues(block, values))}
    >
      <div className={own.parameters}>
        {block.parameters.map((one) => {
          const value = values[one.name]!;
          const fault = fits(value, one) ? null : t('cncSettings.noValue', { name: one.name });
          return (
            <Field key={one.name} row label={one.name} hint={one.comment} error={fault}>
              {(attributes) =>
                one.type === 'BOOL' ? (
                  <Checkbox
                    label={one.name}
                    checked={value === 'TRUE'}
                    onChecked={(checked) => set(one.name)(checked ? 'TRUE' : 'FALSE')}
                  />
                ) : one.values.length > 0 ? (
                  <Select
                    {...attributes}
                    value={value}
                    choices={one.values.map((name) => ({ value: name, text: name }))}
                    onValue={set(one.name)}
                  />
                ) : (
                  <TextInput
                    {...attributes}
                    className="code"
                    inputMode="decimal"
                    value={value}
                    onValue={set(one.name)}
                  />
                )
              }
            </Field>
          );
        })}
      </div>
    </FormDialog>
  );
}
