import type { editor } from 'monaco-editor/editor/editor.api';
import type { ComponentProps } from 'react';
import { flushSync } from 'react-dom';
import { createRoot, type Root } from 'react-dom/client';
import { CellInput } from '@/ui/grid/CellInput';
import { t } from '@/i18n';
import { channelOf } from '@/online/connections';
import { formatLiteral } from '@/online/format';
import type { SubscribedItem } from '@/online/item';
import { checkLiteral } from '@/online/literal';
import { refusePast } from '@/online/past/refuse';
import { prepare, preparedLiteral } from '@/online/prepared';
import { useOpenField } from '@/online/useOpenField';
import { isWritable, togglePrepared } from '@/online/toggle';
import { notify } from '@/ui/notices';
import type { CodeEditor } from '@/text/CodePane';
import type { Monaco } from '@/text/monacoLoader';
import type { PillTarget } from './inlineMonitor';
import styles from './preparePopup.module.css';

let open: (() => void) | null = null;

/** A click on a value prepares another one. */
export function prepareClicked(
  monaco: Monaco,
  target: CodeEditor,
  runtimeId: string,
  event: editor.IEditorMouseEvent,
): void {
  const pill = pillUnder(monaco, event);
  if (pill !== null && event.event.leftButton && event.target.position !== null)
    prepareValue(monaco, target, runtimeId, pill.expression, event.target.position);
}

/** BOOL goes to its next prepared value, others open a field at the place; Enter takes it. */
export function prepareValue(
  monaco: Monaco,
  target: CodeEditor,
  runtimeId: string,
  expression: string,
  position: { lineNumber: number; column: number },
): void {
  const live = channelOf(runtimeId)?.board.get(expression);
  if (live == null || refusePast(runtimeId)) return;
  if (!isWritable(live.item.flags)) {
    notify({ tone: 'info', title: t('online.constantFixed') });
    return;
  }
  if (togglePrepared(runtimeId, expression)) return;
  const value =
    preparedLiteral(runtimeId, expression) ?? (live.value === null ? '' : formatLiteral(live.value, live.item));
  showField(monaco, target, position, live.item, value, (literal) => prepare(runtimeId, expression, literal));
}

/** The field of the pop-up; Write and Force take what is typed in it. */
function PopupField(props: Omit<ComponentProps<typeof CellInput>, 'label' | 'handle'>) {
  return <CellInput {...props} label={t('online.column.prepared')} handle={useOpenField()} />;
}

function pillUnder(monaco: Monaco, event: editor.IEditorMouseEvent): PillTarget | null {
  if (event.target.type !== monaco.editor.MouseTargetType.CONTENT_TEXT) return null;
  const detail = event.target.detail as { injectedText?: { options: editor.InjectedTextOptions } | null };
  const data = detail.injectedText?.options.attachedData as PillTarget | undefined;
  return typeof data?.expression === 'string' ? data : null;
}

function showField(
  monaco: Monaco,
  target: CodeEditor,
  position: { lineNumber: number; column: number },
  item: SubscribedItem,
  value: string,
  done: (literal: string | null) => void,
): void {
  open?.();
  const node = document.createElement('div');
  node.className = styles.popup ?? '';
  const { BELOW, ABOVE } = monaco.editor.ContentWidgetPositionPreference;
  const widget: editor.IContentWidget = {
    getId: () => 'tappet.prepare',
    getDomNode: () => node,
    getPosition: () => ({ position, preference: [BELOW, ABOVE] }),
    allowEditorOverflow: true,
    // Before its first placement the widget is hidden and takes no focus.
    afterRender: () => {
      if (node.contains(document.activeElement)) return;
      const field = node.querySelector('input');
      field?.focus();
      field?.select();
    },
  };
  const root: Root = createRoot(node);
  const close = () => {
    open = null;
    target.removeContentWidget(widget);
    // The field may be in the middle of an event of its own.
    setTimeout(() => root.unmount());
    target.focus();
  };
  open = close;
  const refusal = (text: string) => {
    if (text.trim() === '') return null;
    const result = checkLiteral(text, item);
    return result.ok ? null : t(result.reason, result.values);
  };
  const content = (
    <>
      <div className={styles.title}>
        {item.expression} <i>{item.type}</i>
      </div>
      <div className={styles.field}>
        <PopupField
          value={value}
          suggestions={item.enum ? Object.keys(item.enum) : undefined}
          check={refusal}
          onCommit={(text) => {
            const result = text.trim() === '' ? null : checkLiteral(text, item);
            done(result?.ok === true ? result.literal : null);
            close();
          }}
          onCancel={close}
        />
      </div>
      <div className={styles.hint}>{t('online.prepareHint')}</div>
    </>
  );
  flushSync(() => root.render(content));
  target.addContentWidget(widget);
}
