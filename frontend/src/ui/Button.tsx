import type { ButtonHTMLAttributes, ReactNode, Ref } from 'react';
import type { IconComponent } from '@/icons/IconComponent';
import styles from './Button.module.css';
import { Tooltip } from './Tooltip';

interface CommonProps extends Omit<ButtonHTMLAttributes<HTMLButtonElement>, 'disabled'> {
  ref?: Ref<HTMLButtonElement>;
  icon?: IconComponent;
  /** Why the button cannot be used now: disables it and is its tooltip. */
  disabledReason?: string | null;
}

interface ButtonProps extends CommonProps {
  variant?: 'primary' | 'default' | 'danger' | 'quiet';
  children: ReactNode;
}

/** A disabled button stays focusable and shows why: `aria-disabled` instead of `disabled`. */
function guarded(props: CommonProps): Pick<CommonProps, 'onClick' | 'aria-disabled'> {
  if (!props.disabledReason) return { onClick: props.onClick };
  return { 'aria-disabled': true, onClick: (event) => event.preventDefault() };
}

export function Button({ variant = 'default', icon: Icon, disabledReason, children, className, ...rest }: ButtonProps) {
  const look = variant === 'default' ? '' : styles[variant];
  const button = (
    <button
      type="button"
      {...rest}
      {...guarded({ ...rest, disabledReason })}
      className={`${styles.button} ${look} ${className ?? ''}`}
    >
      {Icon && <Icon size={15} strokeWidth={1.75} aria-hidden />}
      {children}
    </button>
  );
  return disabledReason ? <Tooltip text={disabledReason}>{button}</Tooltip> : button;
}

interface IconButtonProps extends CommonProps {
  icon: IconComponent;
  /** Name for screen readers and first line of the tooltip. */
  label: string;
  /** Key of the command, shown in the tooltip. */
  shortcut?: string;
  pressed?: boolean;
  small?: boolean;
  tone?: string;
}

export function IconButton(props: IconButtonProps) {
  const { icon: Icon, label, shortcut, pressed, small, tone, disabledReason, className, ...rest } = props;
  return (
    <Tooltip text={label} shortcut={shortcut} detail={disabledReason ?? undefined}>
      <button
        type="button"
        aria-label={label}
        aria-pressed={pressed}
        {...rest}
        {...guarded(props)}
        className={`${styles.button} ${styles.icon} ${small ? styles.small : ''} ${className ?? ''}`}
      >
        <Icon
          size={small ? 14 : 16}
          strokeWidth={1.75}
          style={tone && !disabledReason ? { color: tone } : undefined}
          aria-hidden
        />
      </button>
    </Tooltip>
  );
}
