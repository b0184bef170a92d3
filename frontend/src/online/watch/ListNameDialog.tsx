import { useState } from 'react';
import { useText } from '@/i18n';
import { Field, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { listTitle, nameFault } from './listTitle';
import { useWatchLists } from './lists';

interface ListNameDialogProps {
  title: string;
  action: string;
  initial: string;
  /** The list that gets another name; null: a new one. */
  own: string | null;
  close: (name?: string) => void;
}

/** Asks for the name of a watch list; each name is used once. */
export function ListNameDialog({ title, action, initial, own, close }: ListNameDialogProps) {
  const t = useText();
  const lists = useWatchLists((state) => state.lists);
  const [name, setName] = useState(initial);
  const taken = lists.filter((list) => list.id !== own).map((list) => listTitle(t, list));
  const fault = nameFault(name, taken);
  const refused = fault === null ? null : t(`watch.fault.${fault}`, { name: name.trim() });
  return (
    <FormDialog
      title={title}
      action={action}
      disabledReason={refused}
      onClose={() => close()}
      onSubmit={() => close(name.trim())}
    >
      <Field label={t('watch.listName')} error={name === '' ? null : refused}>
        {(attributes) => <TextInput {...attributes} data-autofocus value={name} onValue={setName} />}
      </Field>
    </FormDialog>
  );
}
