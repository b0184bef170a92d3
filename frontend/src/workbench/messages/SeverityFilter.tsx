import type { Severity } from '@/api/types';
import { useText } from '@/i18n';
import { FilterInput, FilterToggles } from '@/ui/Filter';
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
      <FilterToggles kinds={SEVERITIES} hidden={hidden} toggle={toggle}>
        {(severity) => (
          <>
            <SeverityIcon severity={severity} alone={false} />
            {t(`messages.${severity}`, { count: count[severity] })}
          </>
        )}
      </FilterToggles>
      <FilterInput className={styles.search} label={t('messages.search')} value={search} onValue={onSearch} />
    </>
  );
}
