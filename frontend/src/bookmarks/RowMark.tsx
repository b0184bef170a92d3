import { Bookmark } from 'lucide-react';
import { useText } from '@/i18n';
import styles from './marks.module.css';

/** The bookmark of a row of a table. */
export function RowMark() {
  const t = useText();
  return <Bookmark size={12} className={styles.row} role="img" aria-label={t('bookmarks.bookmark')} />;
}
