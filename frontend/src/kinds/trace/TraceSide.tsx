import { Plus, Settings2 } from 'lucide-react';
import { memo, type RefObject } from 'react';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import type { MenuEntry } from '@/ui/Menu';
import type { Handlers } from '@/workbench/commands';
import { reasonText } from '@/workbench/run';
import { changeChannels, withVariables, type Node, type TraceData } from './configuration';
import type { TraceState } from './data/source';
import { TraceTree } from './TraceTree';
import type { TraceScene } from './useTraceActs';
import styles from './Trace.module.css';

const NO_FAULTS: ReadonlySet<string> = new Set();

interface TraceSideProps {
  data: TraceData;
  nodes: readonly Node[];
  /** What the controller does; null while it does not have the trace, or something else is shown. */
  state: TraceState | null;
  active: boolean;
  acts: Handlers;
  menu: () => readonly MenuEntry[];
  scene: RefObject<TraceScene | null>;
  open: (node: Node) => void;
}

/** Records and variables beside the diagrams. Zoom and scroll change nothing of it, so that they do not draw it again. */
export const TraceSide = memo(function TraceSide(props: TraceSideProps) {
  const { data, nodes, state, active, acts, menu, scene, open } = props;
  const t = useText();
  const run = (id: string) => void acts[id]?.run();
  const allowed = (id: string) => acts[id]?.enabled ?? true;
  const adding = allowed('trace.addVariable');
  return (
    <aside className={styles.side}>
      <div className={styles.sideHead}>
        <span>{t('trace.tree')}</span>
      </div>
      <TraceTree
        data={data}
        nodes={nodes}
        onNodes={(chosen) => scene.current?.setView((before) => ({ ...before, nodes: chosen }))}
        menu={menu}
        onOpen={open}
        label={t('trace.tree')}
        faulty={NO_FAULTS}
        states={state?.records.map(({ state: now }) => t(`trace.state.${now}`))}
        active={active}
        onVisible={(of) => {
          const now = scene.current;
          if (now?.mayShow)
            now.change(changeChannels(now.data, of, (channel) => ({ ...channel, visible: !channel.visible })));
        }}
        onDelete={() => allowed('trace.delete') === true && run('trace.delete')}
        onDrop={
          adding === true
            ? (record, variables) => scene.current?.change(withVariables(scene.current.data, record, variables))
            : undefined
        }
      />
      <div className={styles.links}>
        <Button icon={Settings2} variant="quiet" onClick={() => run('trace.configuration')}>
          {t('trace.configuration')}
        </Button>
        <Button
          icon={Plus}
          variant="quiet"
          disabledReason={adding === true ? null : reasonText(adding)}
          onClick={() => run('trace.addVariable')}
        >
          {t('trace.variable')}
        </Button>
      </div>
    </aside>
  );
});
