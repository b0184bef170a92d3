import { useState } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/workbench/ui/Button';
import { Dialog } from '@/workbench/ui/Dialog';
import { Field, TextInput } from '@/workbench/ui/Field';
import { identifierProblem } from './keywords';

/** New name for a symbol. */
export function RenameDialog({ name, close }: { name: string; close: (name?: string) => void }) {
  const t = useText();
  const [next, setNext] = useState(name);
  const problem = identifierProblem(next.trim());
  const error = problem === null ? null : t(`decl.identifier.${problem}`, { name: next.trim() });
  return (
    <Dialog
      title={t('st.renameTitle', { name })}
      description={t('st.renameText')}
      width={420}
      onClose={() => close()}
      onSubmit={() => error === null && close(next.trim())}
      footer={
        <>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button
            type="submit"
            variant="primary"
            disabledReason={error ?? (next.trim() === name ? t('st.sameName') : null)}
          >
            {t('st.rename')}
          </Button>
        </>
      }
    >
      <Field label={t('st.newName')} error={error}>
        {(field) => <TextInput {...field} value={next} onValue={setNext} data-autofocus />}
      </Field>
    </Dialog>
  );
}
