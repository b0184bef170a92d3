import type { IDockviewPanelProps } from 'dockview-react';
import { Suspense } from 'react';
import { usePanel } from '../panels';
import { Loading } from '@/ui/Empty';
import { ErrorBoundary } from '@/ui/ErrorBoundary';
import { useVisible } from './EditorPanel';
import styles from './Panel.module.css';

const NO_OPTIONS = {};

/** A dock panel that holds a registered tool panel. */
export function ToolPanel({ api }: IDockviewPanelProps) {
  const visible = useVisible(api);
  const registration = usePanel(api.id);
  if (!registration) return null;
  const Tool = registration.component;
  return (
    <div className={styles.panel} data-panel-id={api.id}>
      <div className={styles.content}>
        <ErrorBoundary resetKey={api.id}>
          <Suspense fallback={<Loading />}>
            <Tool panelId={api.id} options={registration.props ?? NO_OPTIONS} visible={visible} />
          </Suspense>
        </ErrorBoundary>
      </div>
    </div>
  );
}
