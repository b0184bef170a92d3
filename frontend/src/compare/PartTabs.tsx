import { useText } from '@/i18n';
import styles from './compare.module.css';

type Part = 'declaration' | 'implementation' | 'values';

interface PartTabsProps<One extends Part> {
  parts: readonly One[];
  part: One;
  onPart: (part: One) => void;
}

/** Chooses the part of an object that a comparison shows. */
export function PartTabs<One extends Part>({ parts, part, onPart }: PartTabsProps<One>) {
  const t = useText();
  if (parts.length < 2) return null;
  return (
    <div className={styles.tabs} role="tablist">
      {parts.map((one) => (
        <button
          key={one}
          type="button"
          role="tab"
          aria-selected={one === part}
          className={styles.tab}
          onClick={() => onPart(one)}
        >
          {t(`doc.part.${one}`)}
        </button>
      ))}
    </div>
  );
}
