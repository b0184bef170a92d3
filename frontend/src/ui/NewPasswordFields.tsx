import { useText } from '@/i18n';
import { PasswordField } from './PasswordField';

export interface NewPassword {
  password: string;
  /** The same once more, against slips. */
  again: string;
}

export function isComplete({ password, again }: NewPassword): boolean {
  return password !== '' && again === password;
}

interface NewPasswordFieldsProps {
  label: string;
  value: NewPassword;
  onValue: (value: NewPassword) => void;
}

/** A new password, typed twice. */
export function NewPasswordFields({ label, value, onValue }: NewPasswordFieldsProps) {
  const t = useText();
  const { password, again } = value;
  return (
    <>
      <PasswordField
        label={label}
        autoComplete="new-password"
        value={password}
        onValue={(typed) => onValue({ password: typed, again })}
      />
      <PasswordField
        label={t('firstAccount.again')}
        error={again !== '' && again !== password ? t('firstAccount.differs') : null}
        autoComplete="new-password"
        value={again}
        onValue={(typed) => onValue({ password, again: typed })}
      />
    </>
  );
}
