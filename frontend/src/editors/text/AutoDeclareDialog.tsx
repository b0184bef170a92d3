import { kindOf } from '@/project/kinds';
import { useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { Button } from '@/ui/Button';
import { FormDialog } from '@/ui/FormDialog';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { InputAssistant } from '../assistant/InputAssistant';
import { scopesFor, VARIABLE_FLAGS } from '@/iec/declaration/model';
import type { NewVariable } from '@/iec/declaration/structure';
import styles from '../declaration/Dialogs.module.css';
import { identifierProblem } from '@/iec/keywords';

export interface Declared {
  /** Object whose declaration gets the variable. */
  objectId: string;
  variable: NewVariable;
}

interface AutoDeclareDialogProps {
  projectId: string;
  object: ObjectSummary;
  /** The object itself and the lists a variable may also go to. */
  places: readonly ObjectSummary[];
  keyword: string | null;
  start: NewVariable;
  close: (declared?: Declared) => void;
}

/** Auto Declare: all of a declaration in one form (DECL-60). */
export function AutoDeclareDialog({ projectId, object, places, keyword, start, close }: AutoDeclareDialogProps) {
  const t = useText();
  const [variable, setVariable] = useState(start);
  const [objectId, setObjectId] = useState(places[0]?.id ?? object.id);
  const global = kindOf(places.find((place) => place.id === objectId)?.kind ?? '')?.declares;
  const scopes = global ? ['VAR_GLOBAL'] : scopesFor(keyword);
  const scope = scopes.includes(variable.scope) ? variable.scope : (scopes[0] ?? 'VAR');
  const change = (part: Partial<NewVariable>) => setVariable({ ...variable, ...part });
  const problem = identifierProblem(variable.name.trim());
  const nameError = problem === null ? null : t(`decl.identifier.${problem}`, { name: variable.name });
  const typeError = variable.type.trim() === '' ? t('decl.typeNeeded') : null;
  const error = nameError ?? typeError;
  const submit = () =>
    close({ objectId, variable: { ...variable, scope, name: variable.name.trim(), type: variable.type.trim() } });
  const browse = async () => {
    const chosen = await openDialog<string>((done) => (
      <InputAssistant projectId={projectId} object={object} category="types" close={done} />
    ));
    if (chosen !== undefined) change({ type: chosen });
  };
  return (
    <FormDialog
      title={t('st.autoDeclareTitle')}
      width={520}
      onClose={() => close()}
      onSubmit={submit}
      action={t('st.declare')}
      disabledReason={error}
    >
      <div className={styles.form}>
        <Field label={t('decl.column.scope')}>
          {({ id }) => (
            <Select
              id={id}
              value={scope}
              choices={scopes.map((value) => ({ value, text: value }))}
              onValue={(value) => change({ scope: value })}
            />
          )}
        </Field>
        <Field label={t('decl.column.name')} error={nameError}>
          {(field) => <TextInput {...field} value={variable.name} onValue={(name) => change({ name })} />}
        </Field>
        <Field label={t('decl.column.type')} error={typeError}>
          {(field) => (
            <div className={styles.withButton}>
              <TextInput {...field} value={variable.type} onValue={(type) => change({ type })} data-autofocus />
              <Button aria-label={t('decl.typeBrowser')} onClick={() => void browse()}>
                …
              </Button>
            </div>
          )}
        </Field>
        <Field label={t('st.object')}>
          {({ id }) => (
            <Select
              id={id}
              value={objectId}
              choices={places.map((p) => ({ value: p.id, text: p.name }))}
              onValue={setObjectId}
            />
          )}
        </Field>
        <Field label={t('decl.column.initial')}>
          {(field) => (
            <TextInput {...field} value={variable.initial ?? ''} onValue={(initial) => change({ initial })} />
          )}
        </Field>
        <Field label={t('decl.column.address')}>
          {(field) => (
            <TextInput
              {...field}
              value={variable.address ?? ''}
              placeholder="%IX0.0"
              onValue={(address) => change({ address })}
            />
          )}
        </Field>
        <div className={styles.wide}>
          <Field label={t('decl.column.comment')}>
            {(field) => (
              <TextInput {...field} value={variable.comment ?? ''} onValue={(comment) => change({ comment })} />
            )}
          </Field>
        </div>
        <div className={`${styles.wide} ${styles.flags}`}>
          {VARIABLE_FLAGS.map((flag) => (
            <Checkbox
              key={flag}
              checked={variable.flags.includes(flag)}
              onChecked={(on) =>
                change({ flags: on ? [...variable.flags, flag] : variable.flags.filter((other) => other !== flag) })
              }
            >
              {flag}
            </Checkbox>
          ))}
        </div>
      </div>
    </FormDialog>
  );
}
