import { useEffect, useRef, useState, type KeyboardEvent } from 'react';
import { useText } from '@/i18n';
import grid from '@/ui/grid/CellInput.module.css';
import { SuggestionList } from '@/ui/grid/SuggestionList';
import type { OnlineSession } from '@/workbench/onlineSession';
import { useSymbols } from '../useLive';
import { completionsFor, isComplete, preselected, type ExpressionCompletion } from './completion';

interface ExpressionInputProps {
  session: OnlineSession | null;
  value: string;
  initial: string | undefined;
  onCommit: (text: string) => void;
  onCancel: () => void;
}

const MOST_SHOWN = 200;

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
  const items = found.for === text ? found.items.slice(0, MOST_SHOWN) : [];

  useEffect(() => {
    field.current?.focus();
    if (initial === undefined) field.current?.select();
  }, [initial]);
  useEffect(() => {
    if (tree === null) return;
    let current = true;
    Promise.all([completionsFor(tree, text), isComplete(tree, text)]).then(
      ([next, complete]) => {
        if (!current) return;
        setFound({ for: text, items: next });
        setAt(preselected(next, text, complete));
      },
      () => undefined,
    );
    return () => {
      current = false;
    };
  }, [tree, text]);

  const finish = (commit: boolean, typed = text) => {
    if (done.current) return;
    done.current = true;
    const expression = typed.trim().replace(/\.$/, '');
    if (commit && expression !== value.trim()) onCommit(expression);
    else onCancel();
  };
  /** A variable without components is the end of the path; behind others more may follow. */
  const take = (item: ExpressionCompletion, more: string) => {
    if (item.leaf) {
      finish(true, item.expression);
      return;
    }
    setText(item.expression + more);
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
      take(chosen, '');
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
        <SuggestionList
          anchor={anchor}
          items={items.map((item) => ({ key: item.expression, label: item.name, detail: item.type }))}
          at={at}
          onTake={(index) => take(items[index]!, '.')}
        />
      )}
    </div>
  );
}
