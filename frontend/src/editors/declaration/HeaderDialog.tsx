import { useState } from 'react';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { Button } from '@/ui/Button';
import { FormDialog } from '@/ui/FormDialog';
import { Field, Select, TextArea, TextInput } from '@/ui/Field';
import { identifierProblem } from '@/iec/keywords';
import { AttributesDialog } from './AttributesDialog';
import styles from './Dialogs.module.css';
import { keywordChoices, type HeaderValues } from '@/iec/declaration/header';

interface HeaderDialogProps {
  values: HeaderValues;
  close: (values?: HeaderValues) => void;
}

/** Edit Declaration Header: kind, name, comment and POU-wide attributes (DECL-30). */
export function HeaderDialog({ values, close }: HeaderDialogProps) {
  const t = useText();
  const [keyword, setKeyword] = useState(values.keyword);
  const [name, setName] = useState(values.name);
  const [comment, setComment] = useState(values.comment);
  const [attributes, setAttributes] = useState(values.attributes);
  const problem = identifierProblem(name.trim());
  const error = problem === null ? null : t(`decl.identifier.${problem}`, { name: name.trim() });
  const choices = keywordChoices(values.keyword).map((choice) => ({ value: choice, text: choice }));
  const editAttributes = async () => {
    const text = await openDialog<string>((done) => <AttributesDialog value={attributes.join('\n')} close={done} />);
    if (text !== undefined)
      setAttributes(
        text
          .split('\n')
          .map((line) => line.trim())
          .filter((line) => line !== ''),
      );
  };
  return (
    <FormDialog
      title={t('decl.editHeader')}
      width={480}
      onClose={() => close()}
      onSubmit={() => close({ keyword, name: name.trim(), comment, attributes })}
      action={t('st.ok')}
      disabledReason={error}
      aside={
        <Button style={{ marginRight: 'auto' }} onClick={() => void editAttributes()}>
          {t('decl.attributesButton', { number: attributes.length })}
        </Button>
      }
    >
      <div className={styles.stack}>
        <Field label={t('decl.headerKind')}>
          {({ id }) => (
            <Select id={id} value={keyword} choices={choices} onValue={setKeyword} disabled={choices.length === 1} />
          )}
        </Field>
        <Field label={t('decl.column.name')} error={error}>
          {(field) => <TextInput {...field} value={name} onValue={setName} data-autofocus />}
        </Field>
        <Field label={t('decl.column.comment')}>
          {({ id }) => (
            <TextArea
              id={id}
              className={styles.code}
              rows={4}
              value={comment}
              onValue={setComment}
              onKeyDown={(event) => {
                if (event.key === 'Enter') event.stopPropagation();
              }}
            />
          )}
        </Field>
      </div>
    </FormDialog>
  );
}
