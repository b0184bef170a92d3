/**
 * Dialogs from anywhere, commands included:
 *
 *     const name = await openDialog<string>((close) => <RenameDialog object={object} close={close} />);
 *     if (await confirm({ title: t('...'), text: t('...'), action: t('action.delete'), danger: true })) ...
 *
 * `close()` without a value means cancelled. `DialogHost` (once, in the app) shows them.
 */
import { createElement, Fragment, type ReactElement, type ReactNode } from 'react';
import { create } from 'zustand';
import { ErrorBoundary } from './ErrorBoundary';
import { FormDialog } from './FormDialog';
import { menuOrigin } from './menuOrigin';
import { explain, notify } from './notices';

type Close<Answer> = (answer?: Answer) => void;

interface OpenDialog {
  serial: number;
  element: ReactElement;
  cancel: () => void;
}

const useDialogs = create<{ open: readonly OpenDialog[] }>(() => ({ open: [] }));
let serial = 0;

export function openDialog<Answer = true>(render: (close: Close<Answer>) => ReactElement): Promise<Answer | undefined> {
  const before = placeOfFocus();
  return new Promise((resolve) => {
    const mine = ++serial;
    const close: Close<Answer> = (answer) => {
      useDialogs.setState((state) => ({ open: state.open.filter((dialog) => dialog.serial !== mine) }));
      // Back to where the user was, unless the answer itself moved the focus.
      requestAnimationFrame(() => {
        if (before?.isConnected && document.activeElement === document.body) before.focus();
      });
      resolve(answer);
    };
    useDialogs.setState((state) => ({
      open: [...state.open, { serial: mine, element: render(close), cancel: close }],
    }));
  });
}

/** What has the focus; of an entry of a menu, which is gone when the dialog is, what had it before the menu. */
function placeOfFocus(): HTMLElement | null {
  let place = document.activeElement;
  for (let menu = place?.closest('[role="menu"]'); menu; menu = place?.closest('[role="menu"]'))
    place = menuOrigin(menu);
  return place instanceof HTMLElement ? place : null;
}

export interface Question {
  title: string;
  text?: ReactNode;
  /** Name of the affirmative button. */
  action: string;
  danger?: boolean;
  body?: ReactNode;
}

export async function confirm(question: Question): Promise<boolean> {
  const answer = await openDialog<boolean>((close) => <ConfirmDialog question={question} close={close} />);
  return answer === true;
}

function ConfirmDialog({ question, close }: { question: Question; close: Close<boolean> }) {
  return (
    <FormDialog
      title={question.title}
      description={question.text}
      onClose={() => close()}
      onSubmit={() => close(true)}
      action={question.action}
      danger={question.danger}
      focusAction
    >
      {question.body}
    </FormDialog>
  );
}

/** Shows the open dialogs. When one fails, all are cancelled and the fault is told; the workbench stays. */
export function DialogHost() {
  const open = useDialogs((state) => state.open);
  const onFault = (error: Error) => {
    notify({ tone: 'error', ...explain(error) });
    useDialogs.getState().open.forEach((dialog) => dialog.cancel());
  };
  return (
    <ErrorBoundary resetKey={open.map((dialog) => dialog.serial).join()} onFault={onFault}>
      {open.map((dialog) => createElement(Fragment, { key: dialog.serial }, dialog.element))}
    </ErrorBoundary>
  );
}

/** A modal dialog is up: global keys rest. */
export function dialogOpen(): boolean {
  return useDialogs.getState().open.length > 0;
}
