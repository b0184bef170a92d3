import { useEffect, useRef } from 'react';
import styles from './RadioCards.module.css';

export interface Card<Value extends string> {
  value: Value;
  name: string;
  /** What the choice leads to. */
  effect: string;
}

interface RadioCardsProps<Value extends string> {
  label: string;
  value: Value;
  cards: readonly Card<Value>[];
  onValue: (value: Value) => void;
}

/** One of a few choices that need a sentence each. */
export function RadioCards<Value extends string>({ label, value, cards, onValue }: RadioCardsProps<Value>) {
  const chosen = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    chosen.current?.scrollIntoView({ block: 'nearest' });
  }, []);
  return (
    <div role="radiogroup" aria-label={label} className={styles.cards}>
      {cards.map((card) => (
        <button
          key={card.value}
          ref={card.value === value ? chosen : undefined}
          type="button"
          role="radio"
          aria-checked={card.value === value}
          className={styles.card}
          onClick={() => onValue(card.value)}
        >
          <span className={styles.radio} />
          <span>
            <span className={styles.name}>{card.name}</span>
            <span className={styles.effect}>{card.effect}</span>
          </span>
        </button>
      ))}
    </div>
  );
}
