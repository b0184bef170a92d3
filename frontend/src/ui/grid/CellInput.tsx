import { useEffect, useImperativeHandle, useRef, useState, type KeyboardEvent, type ReactNode, type Ref } from 'react';
import { Floating } from '../Floating';
import styles from './CellInput.module.css';
import { SuggestionList } from './SuggestionList';
import { useProposals, type Proposal, type Propose } from './useProposals';

export interface CellInputHandle {
  /** Shows what may stand at the caret. */
  suggest: () => void;
  /** What is typed so far. */
  text: () => string;
  /** Takes what is typed as Enter does; false when it is refused, which the cell then shows. */
  commit: () => boolean;
}

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
  /** What may stand at the caret, asked while typing. */
  propose?: Propose;
  /** First look at keys; true when the key was used. */
  onKey?: (event: KeyboardEvent, text: string) => boolean;
  handle?: Ref<CellInputHandle>;
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
  const proposals = useProposals(props.propose);
  const caret = () => field.current?.selectionEnd ?? text.length;

  useEffect(() => {
    const input = field.current;
    input?.focus();
    if (initial === undefined) input?.select();
    else {
      input?.setSelectionRange(initial.length, initial.length);
      proposals.ask(initial, initial.length, false);
    }
    // Once, when the cell opens.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [initial]);

  const commit = (key: 'Enter' | 'Tab' | 'blur', backwards = false, taken = text) => {
    if (done.current) return;
    const problem = check?.(taken) ?? null;
    setRefused(problem);
    if (problem !== null) {
      field.current?.focus();
      return;
    }
    done.current = true;
    onCommit(taken, key, backwards);
  };
  useImperativeHandle(props.handle, () => ({
    suggest: () => proposals.ask(text, caret(), true),
    text: () => text,
    commit: () => {
      commit('Enter');
      return done.current;
    },
  }));
  const change = (next: string) => {
    setText(next);
    setRefused(null);
    proposals.ask(next, caret(), false);
  };
  const take = (proposal: Proposal, key?: 'Tab', backwards = false) => {
    const next = text.slice(0, proposal.start) + proposal.insert + text.slice(caret());
    const at = proposal.start + proposal.insert.length;
    proposals.close();
    setText(next);
    if (key !== undefined) commit(key, backwards, next);
    else requestAnimationFrame(() => field.current?.setSelectionRange(at, at));
  };
  const cancel = () => {
    done.current = true;
    onCancel();
  };
  const onKeyDown = (event: KeyboardEvent) => {
    event.stopPropagation();
    if (event.nativeEvent.isComposing) return;
    const { items, at } = proposals;
    if (items.length > 0 && (event.key === 'ArrowDown' || event.key === 'ArrowUp')) {
      event.preventDefault();
      proposals.move(event.key === 'ArrowDown' ? 1 : -1);
    } else if (items.length > 0 && event.key === 'Escape') {
      event.preventDefault();
      proposals.close();
    } else if (items[at] !== undefined && !event.ctrlKey && (event.key === 'Enter' || event.key === 'Tab')) {
      event.preventDefault();
      take(items[at], event.key === 'Tab' ? 'Tab' : undefined, event.shiftKey);
    } else if (props.onKey?.(event, text) === true) {
      event.preventDefault();
    } else if (event.key === 'Escape') {
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
            onChange={(event) => change(event.target.value)}
          />
        </Floating>
      ) : (
        <input {...common} className={styles.input} list={listId} onChange={(event) => change(event.target.value)} />
      )}
      {listId && (
        <datalist id={listId}>
          {props.suggestions?.map((suggestion) => (
            <option key={suggestion} value={suggestion} />
          ))}
        </datalist>
      )}
      {props.button?.(text)}
      {proposals.items.length > 0 && (
        <SuggestionList
          anchor={anchor}
          items={proposals.items.map((item, index) => ({ ...item, key: `${String(index)} ${item.label}` }))}
          at={proposals.at}
          onTake={(index) => take(proposals.items[index]!)}
        />
      )}
      {refused !== null && (
        <Floating anchor={anchor} className={styles.refused}>
          <span role="alert">{refused}</span>
        </Floating>
      )}
    </div>
  );
}
