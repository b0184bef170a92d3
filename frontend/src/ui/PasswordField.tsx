import type { ReactNode } from 'react';
import { Field, TextInput } from './Field';

interface PasswordFieldProps {
  label: string;
  value: string;
  onValue: (value: string) => void;
  /** What a password manager fills in or keeps here. */
  autoComplete: 'current-password' | 'new-password' | 'off';
  name?: string;
  error?: string | null;
  hint?: ReactNode;
}

/** A password or token with its label; what is typed stays hidden. */
export function PasswordField({ label, error, hint, ...input }: PasswordFieldProps) {
  return (
    <Field label={label} error={error} hint={hint}>
      {(attributes) => <TextInput {...attributes} {...input} type="password" />}
    </Field>
  );
}
