import { CircleX, Info, TriangleAlert } from 'lucide-react';
import type { Severity } from '@/api/types';
import { useText } from '@/i18n';
import styles from './Severity.module.css';

const ICONS = { error: CircleX, warning: TriangleAlert, info: Info };

/** The sign of a severity in its colour, with its name where the sign stands alone. */
export function SeverityIcon({ severity, alone }: { severity: Severity; alone: boolean }) {
  const t = useText();
  const Icon = ICONS[severity];
  if (!alone) return <Icon size={14} className={styles[severity]} aria-hidden />;
  return <Icon size={15} className={styles[severity]} aria-label={t(`severity.${severity}`)} />;
}
