import { Search, X } from 'lucide-react';
import { useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import line from '@/ui/SearchLine.module.css';
import styles from './TreeFilter.module.css';

interface TreeFilterProps {
  label: string;
  value: string;
  onValue: (value: string) => void;
}

/** The line above a tree that says which of its rows are shown; Escape empties it. */
export function TreeFilter({ label, value, onValue }: TreeFilterProps) {
  const t = useText();
  return (
    <div className={`${line.search} ${styles.filter}`}>
      <Search size={13} aria-hidden />
      <input
        value={value}
        placeholder={label}
        aria-label={label}
        spellCheck={false}
        onChange={(event) => onValue(event.target.value)}
        onKeyDown={(event) => event.key === 'Escape' && onValue('')}
      />
      {value && <IconButton small icon={X} label={t('tree.clearFilter')} onClick={() => onValue('')} />}
    </div>
  );
}
