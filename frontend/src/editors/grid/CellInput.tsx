import { useEffect, useRef, useState, type KeyboardEvent, type ReactNode } from 'react';
import { Floating } from '@/workbench/ui/Floating';
import styles from './Grid.module.css';

interface CellInputProps {
  label: string;
  value: string;
  /** Key that opened the cell: replaces the value. */
  initial?: string;
  /** Several lines; Ctrl+Enter breaks the line (DECL-29). */
  multiline?: boolean;
  /** Why the text cannot be taken, or null. */
  check?: (text: string) => string | null;
  onCommit: (text: string, key: 'Enter' | 'Tab' | 'blur', backwards: boolean) => void;
  onCancel: () => void;
  /** A button in the cell, such as the type browser. */
  button?: (text: string) => ReactNode;
  suggestions?: readonly string[];
}

/** Edits a cell in place: Enter and leaving take the text, Escape does not; a refused text keeps the cell open. */
export function CellInput(props: CellInputProps) {
  const { value, initial, check, onCommit, onCancel } = props;
  const [text, setText] = useState(initial ?? value);
  const [refused, setRefused] = useState<string | null>(null);
  const field = useRef<HTMLInputElement & HTMLTextAreaElement>(null);
  const frame = useRef<HTMLDivElement>(null);
  const done = useRef(false);
  const [anchor, setAnchor] = useState<HTMLDivElement | null>(null);
  const floating = useRef<HTMLDivElement>(null);

  useEffect(() => {
    const input = field.current;
    input?.focus();
    if (initial === undefined) input?.select();
    else input?.setSelectionRange(initial.length, initial.length);
  }, [initial]);

  const commit = (key: 'Enter' | 'Tab' | 'blur', backwards = false) => {
    if (done.current) return;
    const problem = check?.(text) ?? null;
    setRefused(problem);
    if (problem !== null) {
      field.current?.focus();
      return;
    }
    done.current = true;
    onCommit(text, key, backwards);
  };
  const cancel = () => {
    done.current = true;
    onCancel();
  };
  const onKeyDown = (event: KeyboardEvent) => {
    event.stopPropagation();
    if (event.nativeEvent.isComposing) return;
    if (event.key === 'Escape') {
      event.preventDefault();
      cancel();
    } else if (event.key === 'Enter' && event.ctrlKey && props.multiline === true) {
      event.preventDefault();
      const at = field.current?.selectionStart ?? text.length;
      const end = field.current?.selectionEnd ?? at;
      setText(`${text.slice(0, at)}\n${text.slice(end)}`);
      requestAnimationFrame(() => field.current?.setSelectionRange(at + 1, at + 1));
    } else if (event.key === 'Enter' || event.key === 'Tab') {
      event.preventDefault();
      commit(event.key, event.shiftKey);
    }
  };
  const onBlur = () => {
    requestAnimationFrame(() => {
      const focus = document.activeElement;
      const inside =
        frame.current?.contains(focus) ||
        floating.current?.contains(focus) ||
        // A menu or dialog of the cell's own button belongs to it, too.
        focus?.closest('[role="menu"], [role="dialog"]') != null;
      if (frame.current !== null && !inside && document.hasFocus()) {
        // Leaving an unchanged or refused text gives the cell back as it was.
        if (text === value || (check?.(text) ?? null) !== null) cancel();
        else commit('blur');
      }
    });
  };
  const listId = props.suggestions && `list-${props.label.replace(/\W/g, '')}`;
  const common = {
    ref: field,
    value: text,
    'aria-label': props.label,
    'aria-invalid': refused !== null || undefined,
    spellCheck: false,
    autoComplete: 'off',
    onKeyDown,
    onBlur,
  };
  return (
    <div
      ref={(element) => {
        frame.current = element;
        setAnchor(element);
      }}
      className={styles.edit}
      onDoubleClick={(event) => event.stopPropagation()}
    >
      {props.multiline === true ? (
        <Floating ref={floating} anchor={anchor} place="over">
          <textarea
            {...common}
            className={styles.area}
            rows={Math.min(8, Math.max(2, text.split('\n').length))}
            onChange={(event) => setText(event.target.value)}
          />
        </Floating>
      ) : (
        <input {...common} className={styles.input} list={listId} onChange={(event) => setText(event.target.value)} />
      )}
      {listId && (
        <datalist id={listId}>
          {props.suggestions?.map((suggestion) => (
            <option key={suggestion} value={suggestion} />
          ))}
        </datalist>
      )}
      {props.button?.(text)}
      {refused !== null && (
        <Floating anchor={anchor} className={styles.refused}>
          <span role="alert">{refused}</span>
        </Floating>
      )}
    </div>
  );
}
