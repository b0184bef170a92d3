import type { Severity } from '@/api/types';
import { useText } from '@/i18n';
import { TextInput } from '@/ui/Field';
import { FilterToggle } from '@/ui/FilterToggle';
import styles from './Severity.module.css';
import { SeverityIcon } from './SeverityIcon';

const SEVERITIES: readonly Severity[] = ['error', 'warning', 'info'];

interface SeverityFilterProps {
  count: Record<Severity, number>;
  hidden: ReadonlySet<Severity>;
  toggle: (severity: Severity) => void;
  search: string;
  onSearch: (text: string) => void;
}

/** Above a list of messages: which severities it shows, and the text to look for. */
export function SeverityFilter({ count, hidden, toggle, search, onSearch }: SeverityFilterProps) {
  const t = useText();
  return (
    <>
      {SEVERITIES.map((severity) => (
        <FilterToggle key={severity} shown={!hidden.has(severity)} onToggle={() => toggle(severity)}>
          <SeverityIcon severity={severity} alone={false} />
          {t(`messages.${severity}`, { count: count[severity] })}
        </FilterToggle>
      ))}
      <TextInput
        className={styles.search}
        value={search}
        onValue={onSearch}
        placeholder={t('messages.search')}
        aria-label={t('messages.search')}
      />
    </>
  );
}
