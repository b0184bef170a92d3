import { Check, ChevronDown } from 'lucide-react';
import { Checkbox as RadixCheckbox, Select as RadixSelect } from 'radix-ui';
import { useId, type InputHTMLAttributes, type ReactNode, type Ref, type TextareaHTMLAttributes } from 'react';
import type { IconComponent } from '@/icons/IconComponent';
import styles from './Field.module.css';
import menu from './Menu.module.css';

export interface FieldProps {
  label: string;
  hint?: ReactNode;
  error?: string | null;
  /** Label at the left instead of above. */
  row?: boolean;
  children: (attributes: { id: string; 'aria-invalid'?: boolean; 'aria-describedby'?: string }) => ReactNode;
}

/** Label, control, and below it the error or a hint, tied together for screen readers. */
export function Field({ label, hint, error, row, children }: FieldProps) {
  const id = useId();
  const note = error ?? hint;
  return (
    <div className={`${styles.field} ${row ? styles.row : ''}`}>
      <label className={styles.label} htmlFor={id}>
        {label}
      </label>
      <div className={styles.body}>
        {children({
          id,
          'aria-invalid': error ? true : undefined,
          'aria-describedby': note ? `${id}-note` : undefined,
        })}
        {note && (
          <div id={`${id}-note`} className={error ? styles.error : styles.hint} role={error ? 'alert' : undefined}>
            {note}
          </div>
        )}
      </div>
    </div>
  );
}

interface TextInputProps extends Omit<InputHTMLAttributes<HTMLInputElement>, 'onChange'> {
  ref?: Ref<HTMLInputElement>;
  onValue?: (value: string) => void;
}

export function TextInput({ onValue, className, ...rest }: TextInputProps) {
  return (
    <input
      type="text"
      autoComplete="off"
      spellCheck={false}
      {...rest}
      className={`${styles.input} ${className ?? ''}`}
      onChange={onValue && ((event) => onValue(event.target.value))}
    />
  );
}

interface TextAreaProps extends Omit<TextareaHTMLAttributes<HTMLTextAreaElement>, 'onChange'> {
  onValue: (value: string) => void;
}

/** A text of several lines. */
export function TextArea({ onValue, ...rest }: TextAreaProps) {
  return <textarea className={styles.input} rows={4} {...rest} onChange={(event) => onValue(event.target.value)} />;
}

export interface Choice<Value extends string> {
  value: Value;
  text: string;
  icon?: IconComponent;
  disabled?: boolean;
}

export interface SelectProps<Value extends string> {
  id?: string;
  value: Value | null;
  choices: readonly Choice<Value>[];
  onValue: (value: Value) => void;
  placeholder?: string;
  disabled?: boolean;
  label?: string;
  /** Low and without a frame, for cells of tables. */
  compact?: boolean;
  className?: string;
}

export function Select<Value extends string>(props: SelectProps<Value>) {
  const { id, value, choices, onValue, placeholder, disabled, label, compact, className } = props;
  const chosen = choices.find((choice) => choice.value === value);
  const Icon = chosen?.icon;
  return (
    <RadixSelect.Root value={value ?? ''} onValueChange={(next) => onValue(next as Value)} disabled={disabled}>
      <RadixSelect.Trigger
        id={id}
        aria-label={label}
        className={`${styles.select} ${compact ? styles.compact : ''} ${className ?? ''}`}
      >
        <span style={{ display: 'inline-flex', alignItems: 'center', gap: 6, minWidth: 0 }}>
          {Icon && <Icon size={16} aria-hidden />}
          <RadixSelect.Value placeholder={placeholder}>{chosen?.text}</RadixSelect.Value>
        </span>
        <ChevronDown size={14} aria-hidden />
      </RadixSelect.Trigger>
      <RadixSelect.Portal>
        <RadixSelect.Content className={menu.menu} position="popper" sideOffset={4} collisionPadding={8}>
          <RadixSelect.Viewport style={{ minWidth: 'var(--radix-select-trigger-width)' }}>
            {choices.map((choice) => (
              <RadixSelect.Item
                key={choice.value}
                value={choice.value}
                disabled={choice.disabled}
                className={menu.item}
              >
                <span className={menu.slot}>
                  <RadixSelect.ItemIndicator>
                    <Check size={14} />
                  </RadixSelect.ItemIndicator>
                </span>
                <RadixSelect.ItemText>{choice.text}</RadixSelect.ItemText>
              </RadixSelect.Item>
            ))}
          </RadixSelect.Viewport>
        </RadixSelect.Content>
      </RadixSelect.Portal>
    </RadixSelect.Root>
  );
}

interface CheckboxProps {
  checked: boolean;
  onChecked: (checked: boolean) => void;
  disabled?: boolean;
  /** Its name where none stands beside it, in a column of a table. */
  label?: string;
  children?: ReactNode;
}

export function Checkbox({ checked, onChecked, disabled, label, children }: CheckboxProps) {
  const id = useId();
  return (
    <div className={styles.check}>
      <RadixCheckbox.Root
        id={id}
        className={styles.box}
        aria-label={label}
        checked={checked}
        disabled={disabled}
        onCheckedChange={(state) => onChecked(state === true)}
      >
        <RadixCheckbox.Indicator style={{ display: 'grid' }}>
          <Check size={12} strokeWidth={3} />
        </RadixCheckbox.Indicator>
      </RadixCheckbox.Root>
      {children !== undefined && <label htmlFor={id}>{children}</label>}
    </div>
  );
}
