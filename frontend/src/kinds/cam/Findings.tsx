import { useText } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import { SeverityIcon } from '@/workbench/messages/SeverityIcon';
import { Button } from '@/ui/Button';
import { explain } from '@/ui/notices';
import type { CamTable } from './camTable';
import styles from './Cam.module.css';
import type { CamFinding } from './curves';
import type { CamEdit } from './edit';

interface FindingsProps {
  findings: readonly CamFinding[];
  error: unknown;
  again: () => void;
  edit: CamEdit;
}

/** What is wrong with the cam (CAM-74); a click leads to the place. */
export function Findings({ findings, error, again, edit }: FindingsProps) {
  const t = useText();
  if (error !== null)
    return (
      <div className={styles.refused} role="alert">
        {explain(error).text ?? explain(error).title}
        <Button variant="quiet" onClick={again}>
          {t('action.retry')}
        </Button>
      </div>
    );
  if (findings.length === 0) return null;
  return (
    <ul className={styles.findings} aria-label={t('cam.findings')}>
      {findings.map((finding, at) => (
        <li key={at}>
          <button type="button" onClick={() => edit.select({ kind: 'point', index: nearest(edit.cam, finding.x) })}>
            <SeverityIcon severity={finding.severity === 'information' ? 'info' : finding.severity} alone />
            <span>{finding.text}</span>
            <span className={styles.at}>{`X ${numberText(finding.x)}`}</span>
          </button>
        </li>
      ))}
    </ul>
  );
}

/** The point at a position of the master. */
function nearest(cam: CamTable, x: number): number {
  let best = 0;
  cam.points.forEach((point, index) => {
    if (Math.abs(point.x - x) < Math.abs(cam.points[best]!.x - x)) best = index;
  });
  return best;
}
