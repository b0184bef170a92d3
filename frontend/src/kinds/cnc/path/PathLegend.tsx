import type { CSSProperties } from 'react';
import { useText } from '@/i18n';
import { usePreferences } from '@/session/preferences';
import styles from './Path.module.css';
import type { Colouring, PathSummary } from './pathView';

/** As the server draws them. */
const KINDS = {
  light: { rapid: 'rgb(22 132 70)', feed: 'rgb(26 28 32)', arc: 'rgb(20 90 190)' },
  dark: { rapid: 'rgb(76 201 122)', feed: 'rgb(232 235 239)', arc: 'rgb(120 178 255)' },
} as const;
const UNITS = { velocity: 'u/s', acceleration: 'u/s²', curvature: '1/u' } as const;

interface PathLegendProps {
  colouring: Colouring;
  legend: PathSummary['legend'];
}

/** What the colours of the path stand for. */
export function PathLegend({ colouring, legend }: PathLegendProps) {
  const t = useText();
  const theme = usePreferences((state) => state.shown);
  if (colouring === 'kind' || legend === null) {
    const colours = KINDS[theme];
    return (
      <div className={`${styles.legend} ${styles.kinds}`} data-testid="path-legend">
        {(['rapid', 'feed', 'arc'] as const).map((kind) => (
          <span key={kind} style={{ '--kind': colours[kind] } as CSSProperties}>
            {t(`cnc.path.kind.${kind}`)}
          </span>
        ))}
      </div>
    );
  }
  return (
    <div className={styles.legend} data-testid="path-legend">
      <div>
        {t(`cnc.path.colouring.${colouring}`)} [{UNITS[colouring]}]
        {colouring !== 'curvature' && !legend.by_motion && ` · ${t('cnc.path.programmed')}`}
      </div>
      <div className={styles.scale} style={{ background: `linear-gradient(90deg, ${legend.colours.join(', ')})` }} />
      <div className={styles.ends}>
        <span>{numberText(legend.low)}</span>
        <span>{numberText(legend.high)}</span>
      </div>
    </div>
  );
}

function numberText(value: number): string {
  return String(Number(value.toPrecision(4)));
}
