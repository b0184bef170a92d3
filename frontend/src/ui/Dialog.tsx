import { X } from 'lucide-react';
import { Dialog as Radix } from 'radix-ui';
import type { CSSProperties, FormEvent, KeyboardEvent, ReactNode } from 'react';
import { useText } from '@/i18n';
import { IconButton } from './Button';
import styles from './Dialog.module.css';

export interface DialogProps {
  title: string;
  description?: ReactNode;
  width?: number;
  onClose: () => void;
  /** Makes the dialog a form: Enter submits. */
  onSubmit?: () => void;
  footer?: ReactNode;
  children?: ReactNode;
}

/** A modal dialog. Shown while it is mounted; Escape and the cross close it. */
export function Dialog({ title, description, width, onClose, onSubmit, footer, children }: DialogProps) {
  const t = useText();
  const content = (
    <>
      <div className={styles.head}>
        {/* Menu entries that open a dialog end in an ellipsis; the dialog itself does not. */}
        <Radix.Title className={styles.title}>{title.replace(/…$/, '')}</Radix.Title>
        <IconButton icon={X} label={t('action.close')} small onClick={onClose} />
      </div>
      {description && <Radix.Description className={styles.description}>{description}</Radix.Description>}
      {children && <div className={styles.body}>{children}</div>}
      {footer && <div className={styles.foot}>{footer}</div>}
    </>
  );
  const submit = (event: FormEvent) => {
    event.preventDefault();
    event.stopPropagation();
    onSubmit?.();
  };
  return (
    <Radix.Root open onOpenChange={(open) => !open && onClose()}>
      <Radix.Portal>
        <Radix.Overlay className={styles.scrim} />
        <Radix.Content
          className={styles.dialog}
          style={width ? ({ '--dialog-width': `${width}px` } as CSSProperties) : undefined}
          aria-describedby={description ? undefined : ''}
          onOpenAutoFocus={focusFirstField}
        >
          {onSubmit ? (
            <form onSubmit={submit} onKeyDown={submitFromRadio} style={{ display: 'contents' }}>
              {content}
            </form>
          ) : (
            content
          )}
        </Radix.Content>
      </Radix.Portal>
    </Radix.Root>
  );
}

/** Our radios are buttons: Enter would only choose again what is chosen, where every dialog takes it as the answer. */
function submitFromRadio(event: KeyboardEvent<HTMLFormElement>): void {
  if (event.key !== 'Enter' || !(event.target instanceof Element) || event.target.role !== 'radio') return;
  event.preventDefault();
  event.currentTarget.requestSubmit();
}

/** The first field, or the button that stands for the expected answer, gets the focus instead of the closing cross. */
function focusFirstField(event: Event): void {
  const dialog = event.currentTarget as HTMLElement | null;
  const target =
    dialog?.querySelector<HTMLElement>('[data-autofocus]') ??
    dialog?.querySelector<HTMLElement>(`.${styles.body} :is(input, [role="combobox"], [role="grid"], textarea)`) ??
    dialog?.querySelector<HTMLElement>(`.${styles.foot} button:not([aria-disabled]):last-of-type`) ??
    dialog;
  if (!target) return;
  event.preventDefault();
  target.focus();
  if (target instanceof HTMLInputElement) target.select();
}
