import { Ellipsis } from 'lucide-react';
import { useState } from 'react';
import type { ObjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { InputAssistant } from '@/editors/assistant/InputAssistant';
import { IconButton } from '@/ui/Button';
import { Checkbox, Field, Select, TextInput } from '@/ui/Field';
import { openDialog } from '@/ui/dialogs';
import type { Fault } from './configuration';
import styles from './Trace.module.css';

/** What the fields of the settings share. */
export interface FieldContext {
  disabled: boolean;
  projectId: string;
  object: ObjectSummary | undefined;
  /** What is wrong with a field of the node that is shown. */
  faultOf: (field: string) => string | null;
}

export function faultText(t: ReturnType<typeof useText>, faults: readonly Fault[], field: string): string | null {
  const fault = faults.find((one) => one.field === field);
  return fault ? t(fault.key, fault.values) : null;
}

interface TextFieldProps {
  label: string;
  field: string;
  /** Null: the chosen variables differ. */
  value: string | null;
  context: FieldContext;
  hint?: string;
  /** A name of the project can be chosen by F2. */
  assisted?: boolean;
  code?: boolean;
  onValue: (value: string) => void;
}

/** A text; one with the input assistant where it names a variable. */
export function SettingText({ label, field, value, context, hint, assisted, code, onValue }: TextFieldProps) {
  const t = useText();
  const choose = async () => {
    const found = await openDialog<string>((close) => (
      <InputAssistant projectId={context.projectId} object={context.object} typed={value ?? ''} close={close} />
    ));
    if (found !== undefined) onValue(found);
  };
  return (
    <Field row label={label} error={context.faultOf(field)} hint={hint}>
      {(attributes) => (
        <div className={assisted ? styles.withButton : undefined}>
          <TextInput
            {...attributes}
            className={code ? 'code' : undefined}
            disabled={context.disabled}
            value={value ?? ''}
            placeholder={value === null ? t('trace.several') : undefined}
            onValue={onValue}
            onKeyDown={(event) => {
              if (event.key !== 'F2' || !assisted) return;
              event.preventDefault();
              event.stopPropagation();
              void choose();
            }}
          />
          {assisted && (
            <IconButton
              icon={Ellipsis}
              label={t('trace.assistant')}
              shortcut="F2"
              disabledReason={context.disabled ? t('reason.engineer') : null}
              onClick={() => void choose()}
            />
          )}
        </div>
      )}
    </Field>
  );
}

interface NumberSettingProps {
  label: string;
  field: string;
  value: number | null;
  context: FieldContext;
  unit?: string;
  hint?: string;
  onValue: (value: number) => void;
}

/** A number; what is no number is told at the field. */
export function SettingNumber({ label, field, value, context, unit, hint, onValue }: NumberSettingProps) {
  const t = useText();
  const [typed, setTyped] = useState<string | null>(null);
  return (
    <Field row label={label} error={context.faultOf(field)} hint={hint}>
      {(attributes) => (
        <div className={unit ? styles.withButton : undefined}>
          <TextInput
            {...attributes}
            className="code"
            inputMode="decimal"
            disabled={context.disabled}
            value={typed ?? (value === null || Number.isNaN(value) ? '' : String(value))}
            placeholder={value === null ? t('trace.several') : undefined}
            onValue={(text) => {
              setTyped(text);
              onValue(text.trim() === '' ? NaN : Number(text.replace(',', '.')));
            }}
            onBlur={() => setTyped(null)}
          />
          {unit && (
            <span className={styles.muted} style={{ flex: 'none', alignSelf: 'center' }}>
              {unit}
            </span>
          )}
        </div>
      )}
    </Field>
  );
}

interface ChoiceProps<Value extends string> {
  label: string;
  value: Value | null;
  values: readonly Value[];
  textOf: (value: Value) => string;
  context: FieldContext;
  onValue: (value: Value) => void;
}

export function SettingChoice<Value extends string>(props: ChoiceProps<Value>) {
  const { label, value, values, textOf, context, onValue } = props;
  const t = useText();
  return (
    <Field row label={label}>
      {(attributes) => (
        <Select<Value>
          {...attributes}
          value={value}
          placeholder={t('trace.several')}
          disabled={context.disabled}
          choices={values.map((one) => ({ value: one, text: textOf(one) }))}
          onValue={onValue}
        />
      )}
    </Field>
  );
}

interface ColorProps {
  label: string;
  /** Empty: automatic. */
  value: string | null;
  context: FieldContext;
  /** Shown in place of an automatic colour. */
  usual: string;
  required?: boolean;
  onValue: (value: string) => void;
}

/** A colour, or the automatic one (TRC-41). */
export function SettingColor({ label, value, context, usual, required, onValue }: ColorProps) {
  const t = useText();
  return (
    <Field row label={label}>
      {(attributes) => (
        <div className={styles.color}>
          <input
            {...attributes}
            type="color"
            disabled={context.disabled}
            value={value || hex(usual)}
            onChange={(event) => onValue(event.target.value)}
          />
          {!required && (
            <Checkbox
              checked={value === ''}
              disabled={context.disabled}
              onChecked={(on) => onValue(on ? '' : hex(usual))}
            >
              {t('trace.automatic')}
            </Checkbox>
          )}
        </div>
      )}
    </Field>
  );
}

const hex = (color: string) => (/^#[0-9a-f]{6}$/i.test(color) ? color : '#808080');

/** The value that all have, null where they differ. */
export function common<Of, Value>(all: readonly Of[], value: (one: Of) => Value): Value | null {
  const [first, ...rest] = all.map(value);
  return first !== undefined && rest.every((one) => one === first) ? first : null;
}
