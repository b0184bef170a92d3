import { Unplug } from 'lucide-react';
import { useText } from '@/i18n';
import { timeText } from '@/workbench/clock';
import type { OnlineSession } from '@/workbench/onlineSession';
import styles from './OnlineTable.module.css';

/** Says since when the values below stand still. Nothing while the connection is there. */
export function LostBar({ session }: { session: OnlineSession | null }) {
  const t = useText();
  if (session === null || session.lostSince === null) return null;
  return (
    <div className={`${styles.bar} ${styles.lost}`} role="status">
      <Unplug size={14} aria-hidden />
      {t('online.frozenSince', { time: timeText(session.lostSince) })}
    </div>
  );
}
