import { useText } from '@/i18n';
import styles from './DocumentBars.module.css';
import type { Part } from '@/project/partUri';

/** Chooses the part of an object that a comparison shows. */
export function PartTabs({
  parts,
  part,
  onPart,
}: {
  parts: readonly Part[];
  part: Part;
  onPart: (part: Part) => void;
}) {
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
