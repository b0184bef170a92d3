import { useState, type FormEvent, type ReactNode } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Field, TextInput } from '@/ui/Field';
import styles from './Login.module.css';

interface LoginFormProps {
  action: string;
  /** What is still to be filled in, or null. */
  missing: string | null;
  /** Sends the form; what it throws is shown above the fields. */
  send: () => Promise<void>;
  refusal: (error: unknown) => string;
  children: ReactNode;
}

/** A form before login: its fields, its one button, and why the server refused. */
export function LoginForm({ action, missing, send, refusal, children }: LoginFormProps) {
  const [refused, setRefused] = useState<string | null>(null);
  const [busy, setBusy] = useState(false);
  const submit = async (event: FormEvent) => {
    event.preventDefault();
    if (busy || missing) return;
    setBusy(true);
    try {
      await send();
    } catch (error) {
      setRefused(refusal(error));
    } finally {
      setBusy(false);
    }
  };
  return (
    <form className={styles.form} onSubmit={(event) => void submit(event)}>
      {refused && (
        <div className={styles.error} role="alert">
          {refused}
        </div>
      )}
      {children}
      <Button type="submit" variant="primary" disabledReason={missing}>
        {action}
      </Button>
    </form>
  );
}

interface UsernameFieldProps {
  value: string;
  onValue: (value: string) => void;
  autoFocus: boolean;
}

export function UsernameField(props: UsernameFieldProps) {
  const t = useText();
  return (
    <Field label={t('signIn.username')}>
      {(attributes) => <TextInput {...attributes} {...props} autoComplete="username" name="username" />}
    </Field>
  );
}
