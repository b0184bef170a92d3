import { useEffect, useRef, useState, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import { Floating } from '@/editors/grid/Floating';
import grid from '@/editors/grid/Grid.module.css';
import type { OnlineSession } from '@/workbench/onlineSession';
import { useSymbols } from '../useLive';
import { completionsFor, type ExpressionCompletion } from './completion';
import styles from './ExpressionInput.module.css';

interface ExpressionInputProps {
  session: OnlineSession | null;
  value: string;
  initial: string | undefined;
  onCommit: (text: string) => void;
  onCancel: () => void;
}

/** Types an expression with the variables of the loaded application as suggestions. */
export function ExpressionInput({ session, value, initial, onCommit, onCancel }: ExpressionInputProps) {
  const t = useText();
  const tree = useSymbols(session);
  const [text, setText] = useState(initial ?? value);
  const [found, setFound] = useState<{ for: string; items: readonly ExpressionCompletion[] }>({ for: '', items: [] });
  const [at, setAt] = useState(-1);
  const field = useRef<HTMLInputElement>(null);
  const done = useRef(false);
  const [anchor, setAnchor] = useState<HTMLDivElement | null>(null);
  const items = found.for === text ? found.items : [];

  useEffect(() => {
    field.current?.focus();
    if (initial === undefined) field.current?.select();
  }, [initial]);
  useEffect(() => {
    if (tree === null) return;
    let current = true;
    completionsFor(tree, text).then(
      (next) => {
        if (!current) return;
        setFound({ for: text, items: next });
        setAt(-1);
      },
      () => undefined,
    );
    return () => {
      current = false;
    };
  }, [tree, text]);

  const finish = (commit: boolean) => {
    if (done.current) return;
    done.current = true;
    if (commit && text.trim() !== value.trim()) onCommit(text);
    else onCancel();
  };
  const take = (item: ExpressionCompletion) => {
    setText(item.expression + (item.leaf ? '' : '.'));
    field.current?.focus();
  };
  const onKeyDown = (event: KeyboardEvent) => {
    event.stopPropagation();
    if (event.nativeEvent.isComposing) return;
    const chosen = items[at];
    if (event.key === 'ArrowDown' || event.key === 'ArrowUp') {
      event.preventDefault();
      if (items.length > 0) setAt((at + (event.key === 'ArrowDown' ? 1 : items.length)) % items.length);
    } else if ((event.key === 'Enter' || event.key === 'Tab') && chosen !== undefined) {
      event.preventDefault();
      take(chosen);
    } else if (event.key === 'Enter' || event.key === 'Tab') {
      event.preventDefault();
      finish(true);
    } else if (event.key === 'Escape') {
      event.preventDefault();
      finish(false);
    }
  };
  return (
    <div ref={setAnchor} className={grid.edit} onDoubleClick={(event) => event.stopPropagation()}>
      <input
        ref={field}
        className={grid.input}
        value={text}
        spellCheck={false}
        autoComplete="off"
        role="combobox"
        aria-expanded={items.length > 0}
        aria-label={t('online.column.expression')}
        placeholder="PLC_PRG."
        onChange={(event) => setText(event.target.value)}
        onKeyDown={onKeyDown}
        onBlur={() => finish(true)}
      />
      {items.length > 0 && (
        <Floating anchor={anchor} className={styles.list}>
          <div role="listbox">
            {items.slice(0, 12).map((item, index) => (
              <div
                key={item.expression}
                role="option"
                aria-selected={index === at}
                className={styles.option}
                onPointerDown={(event) => {
                  event.preventDefault();
                  take(item);
                }}
              >
                <span>{item.name}</span>
                <i>{item.type}</i>
              </div>
            ))}
          </div>
        </Floating>
      )}
    </div>
  );
}
