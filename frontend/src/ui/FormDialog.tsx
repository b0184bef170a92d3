import type { ReactNode } from 'react';
import { useText } from '@/i18n';
import { Button } from './Button';
import { Dialog, type DialogProps } from './Dialog';

interface FormDialogProps extends Omit<DialogProps, 'footer' | 'onSubmit'> {
  /** Name of the button that submits, the expected answer. */
  action: string;
  danger?: boolean;
  /** Why the form cannot be submitted now: disables the button and is its tooltip; Enter does nothing then. */
  disabledReason?: string | null;
  /** The form has no field to begin with: its button gets the focus. */
  focusAction?: boolean;
  /** The action stops something: Cancel gets the focus, so that Enter alone does not agree. */
  focusCancel?: boolean;
  /** What stands in the foot before the buttons. */
  aside?: ReactNode;
  onSubmit: () => void;
}

/** A dialog that asks for something: it is submitted by its button or Enter, or cancelled. */
export function FormDialog({
  action,
  danger,
  disabledReason,
  focusAction,
  focusCancel,
  aside,
  onSubmit,
  onClose,
  ...rest
}: FormDialogProps) {
  const t = useText();
  return (
    <Dialog
      {...rest}
      onClose={onClose}
      onSubmit={() => disabledReason || onSubmit()}
      footer={
        <>
          {aside}
          <Button onClick={onClose} data-autofocus={focusCancel || undefined}>
            {t('action.cancel')}
          </Button>
          <Button
            type="submit"
            variant={danger ? 'danger' : 'primary'}
            disabledReason={disabledReason}
            data-autofocus={focusAction || undefined}
          >
            {action}
          </Button>
        </>
      }
    />
  );
}
