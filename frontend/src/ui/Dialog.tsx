import { X } from 'lucide-react';
import { Dialog as Radix } from 'radix-ui';
import {
  useEffect,
  useRef,
  type CSSProperties,
  type FormEvent,
  type KeyboardEvent,
  type ReactNode,
  type RefObject,
} from 'react';
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
  const frame = useRef<HTMLDivElement>(null);
  useEscapeBesideTooltip(frame, onClose);
  return (
    <Radix.Root open onOpenChange={(open) => !open && onClose()}>
      <Radix.Portal>
        <Radix.Overlay className={styles.scrim} />
        <Radix.Content
          ref={frame}
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

/** Escape closes a dialog also while a tooltip is shown, which would take the key for itself. */
function useEscapeBesideTooltip(frame: RefObject<HTMLElement | null>, onClose: () => void): void {
  const close = useRef(onClose);
  useEffect(() => {
    close.current = onClose;
  });
  useEffect(() => {
    const onKey = (event: globalThis.KeyboardEvent) => {
      // The keyboard is in the dialog itself: no menu or further dialog lies above it.
      const own = event.target instanceof Node && frame.current?.contains(event.target) === true;
      if (event.key === 'Escape' && own && document.querySelector('[role="tooltip"]') !== null) close.current();
    };
    document.addEventListener('keydown', onKey, true);
    return () => document.removeEventListener('keydown', onKey, true);
  }, [frame]);
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
    dialog?.querySelector<HTMLElement>(
      `.${styles.body} :is(input:not([hidden]), [role="combobox"], [role="grid"], textarea)`,
    ) ??
    dialog?.querySelector<HTMLElement>(`.${styles.foot} button:not([aria-disabled]):last-of-type`) ??
    dialog;
  if (!target) return;
  event.preventDefault();
  target.focus({ preventScroll: true }); // What is chosen further down has come into view
  if (target instanceof HTMLInputElement) target.select();
}
