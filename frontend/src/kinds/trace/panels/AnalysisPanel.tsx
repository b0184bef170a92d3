import { X } from 'lucide-react';
import { useText } from '@/i18n';
import { IconButton } from '@/ui/Button';
import type { TraceData } from '../configuration';
import type { RunData } from '../data/runData';
import { seenTime, type OverlayRun } from '../Diagrams';
import { PANELS, type PanelId, type TraceView } from '../traceView';
import styles from '../Trace.module.css';
import panel from './Panels.module.css';
import { ComparePanel } from './ComparePanel';
import { MeasurePanel, StatisticsPanel } from './MeasurePanel';
import { RecordingsPanel } from './RecordingsPanel';
import { SpectrumPanel } from './SpectrumPanel';
import { useSettled } from './useSettled';
import { XyPanel } from './XyPanel';

interface AnalysisPanelProps {
  projectId: string;
  trace: string;
  data: TraceData;
  run: RunData | null;
  live: boolean;
  overlays: readonly OverlayRun[];
  view: TraceView;
  onView: (change: (view: TraceView) => TraceView) => void;
  onConfiguration: ((data: TraceData) => void) | null;
}

/** What is measured and computed of the curves, and the stored recordings: tabs below the diagrams. */
export function AnalysisPanel(props: AnalysisPanelProps) {
  const { projectId, trace, data, run, live, overlays, view, onView, onConfiguration } = props;
  const t = useText();
  const seen = useSettled(seenTime(data, run, live, view.views.now.x));
  const open = (panel: PanelId | null) => onView((before) => ({ ...before, panel }));
  const content = () => {
    if (view.panel === 'recordings')
      return (
        <RecordingsPanel
          projectId={projectId}
          trace={trace}
          view={view}
          onView={onView}
          onConfiguration={onConfiguration}
          data={data}
        />
      );
    if (run === null) return <p className={styles.note}>{t('trace.reason.shown')}</p>;
    const [one, other] = view.cursors;
    const between =
      one === undefined || other === undefined ? null : { min: Math.min(one, other), max: Math.max(one, other) };
    const range = between ?? seen;
    switch (view.panel) {
      case 'measure':
        return <MeasurePanel data={data} run={run} live={live} cursors={view.cursors} range={between} />;
      case 'statistics':
        return <StatisticsPanel data={data} run={run} live={live} cursors={[]} range={range} />;
      case 'spectrum':
        return <SpectrumPanel data={data} run={run} range={range} />;
      case 'xy':
        return <XyPanel data={data} run={run} live={live} range={range} />;
      case 'compare':
        return <ComparePanel data={data} run={run} range={range} overlays={overlays} view={view} onView={onView} />;
      case null:
        return null;
    }
  };
  return (
    <>
      <div className={panel.panelTabs} role="tablist" aria-label={t('trace.analysis')}>
        {PANELS.map((panel) => (
          <button
            type="button"
            key={panel}
            role="tab"
            aria-selected={view.panel === panel}
            onClick={() => open(view.panel === panel ? null : panel)}
          >
            {t(`trace.panel.${panel}`)}
          </button>
        ))}
        <span className={styles.grow} />
        {view.panel !== null && <IconButton icon={X} small label={t('action.close')} onClick={() => open(null)} />}
      </div>
      {view.panel !== null && (
        <div className={panel.panel} role="tabpanel" aria-label={t(`trace.panel.${view.panel}`)}>
          <div className={panel.panelBody}>{content()}</div>
        </div>
      )}
    </>
  );
}
