import { Floating } from '../Floating';
import styles from './SuggestionList.module.css';

export interface Suggestion {
  readonly key: string;
  readonly label: string;
  readonly detail: string;
}

interface SuggestionListProps {
  anchor: HTMLElement | null;
  items: readonly Suggestion[];
  /** The one that Enter takes; -1 for none. */
  at: number;
  onTake: (index: number) => void;
}

// Returns nothing: newer browsers give a promise, which React would take for a function that cleans up.
const intoView = (option: HTMLElement | null) => {
  option?.scrollIntoView({ block: 'nearest' });
};

/** What could be meant, below the field it is typed into; the field keeps the focus. */
export function SuggestionList({ anchor, items, at, onTake }: SuggestionListProps) {
  return (
    <Floating anchor={anchor} className={styles.list}>
      <div role="listbox">
        {items.map((item, index) => (
          <div
            key={item.key}
            role="option"
            aria-selected={index === at}
            ref={index === at ? intoView : undefined}
            className={styles.option}
            onPointerDown={(event) => {
              event.preventDefault();
              onTake(index);
            }}
          >
            <span>{item.label}</span>
            <i>{item.detail}</i>
          </div>
        ))}
      </div>
    </Floating>
  );
}
