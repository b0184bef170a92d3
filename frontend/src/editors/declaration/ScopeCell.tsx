import { useEffect, useRef, useState, type KeyboardEvent } from 'react';
import { Checkbox } from '@/ui/Field';
import { useText } from '@/i18n';
import { Floating } from '@/ui/Floating';
import styles from './DeclarationTable.module.css';
import { scopesFor, VARIABLE_FLAGS, type DeclarationModel } from '@/iec/declaration/model';

interface ScopeCellProps {
  model: DeclarationModel;
  /** `VAR_INPUT CONSTANT` */
  value: string;
  onCommit: (value: string) => void;
  onCancel: () => void;
}

/** Drop-down of the scopes this object allows, with the flags as check boxes (DECL-26). */
export function ScopeCell({ model, value, onCommit, onCancel }: ScopeCellProps) {
  const t = useText();
  const [scope = '', ...flags] = value.split(' ');
  const [chosen, setChosen] = useState<readonly string[]>(flags);
  const list = useRef<HTMLDivElement>(null);
  const [anchor, setAnchor] = useState<HTMLElement | null>(null);
  const scopes = scopesFor(model.header?.keyword.text.toUpperCase() ?? null);
  const choices = scopes.includes(scope) ? scopes : [scope, ...scopes];

  useEffect(() => {
    list.current?.querySelector<HTMLElement>('[aria-checked="true"]')?.focus();
  }, []);

  const others = flags.filter((flag) => !VARIABLE_FLAGS.some((known) => known === flag));
  const compose = (next: string, with_: readonly string[]) =>
    [next, ...others, ...VARIABLE_FLAGS.filter((flag) => with_.includes(flag))].join(' ');
  const onKeyDown = (event: KeyboardEvent) => {
    event.stopPropagation();
    if (event.key === 'Escape') onCancel();
    if (event.key !== 'ArrowDown' && event.key !== 'ArrowUp') return;
    event.preventDefault();
    const items = [...(list.current?.querySelectorAll<HTMLElement>('button') ?? [])];
    const at = items.indexOf(document.activeElement as HTMLElement);
    items[(at + (event.key === 'ArrowDown' ? 1 : items.length - 1)) % items.length]?.focus();
  };
  const onBlur = () => {
    requestAnimationFrame(() => {
      if (list.current === null || list.current.contains(document.activeElement)) return;
      const next = compose(scope, chosen);
      if (next === compose(scope, flags)) onCancel();
      else onCommit(next);
    });
  };
  return (
    <>
      <span ref={setAnchor} className={styles.scopeAnchor}>
        {value}
      </span>
      <Floating anchor={anchor} ref={list}>
        <div
          className={styles.scopeMenu}
          role="menu"
          aria-label={t('decl.column.scope')}
          tabIndex={-1}
          onKeyDown={onKeyDown}
          onBlur={onBlur}
        >
          {choices.map((choice) => (
            <button
              key={choice}
              type="button"
              role="menuitemradio"
              aria-checked={choice === scope}
              className={styles.scopeChoice}
              onClick={() => onCommit(compose(choice, chosen))}
            >
              {choice}
            </button>
          ))}
          <div className={styles.scopeFlags}>
            {VARIABLE_FLAGS.map((flag) => (
              <Checkbox
                key={flag}
                checked={chosen.includes(flag)}
                onChecked={(on) => setChosen(on ? [...chosen, flag] : chosen.filter((other) => other !== flag))}
              >
                {flag}
              </Checkbox>
            ))}
          </div>
        </div>
      </Floating>
    </>
  );
}
