import { Fragment, useMemo, useRef, type KeyboardEvent, type PointerEvent } from 'react';
import { ChevronRight } from 'lucide-react';
import { useText } from '@/i18n';
import { domainOf } from './camTable';
import styles from './Cam.module.css';
import type { CamEdit, GraphLayout, Tool } from './edit';
import { Graph } from './Graph';
import { type GraphName, GRAPHS, MARGIN_LEFT, MARGIN_RIGHT, niceStep, type Range, ticks, tickText } from './plot';
import { useSize } from '@/editors/plot/useSize';

const LEAST_SHARE = 0.15;
const KEY_SHARE = 0.1;
const X_TICK_PX = 90;

interface GraphsTabProps {
  edit: CamEdit;
  tool: Tool;
  onTool: (tool: Tool) => void;
  layout: GraphLayout;
  onLayout: (layout: GraphLayout) => void;
}

/** The four graphs above each other, each with a bar below it that is dragged, over one axis of the master (CAM-30 to CAM-33). */
export function GraphsTab({ edit, tool, onTool, layout, onLayout }: GraphsTabProps) {
  const t = useText();
  const frame = useRef<HTMLDivElement>(null);
  const resized = useRef<{ above: GraphName; below: GraphName; y: number; layout: GraphLayout } | null>(null);
  const window = useMemo((): Range => {
    const [min, max] = domainOf(edit.cam);
    const zoom = layout.window;
    if (zoom === null || zoom.max <= min || zoom.min >= max) return { min, max };
    return { min: Math.max(min, zoom.min), max: Math.min(max, zoom.max) };
  }, [edit.cam, layout.window]);
  const open = GRAPHS.filter((graph) => !layout.closed[graph]);
  const sum = open.reduce((total, graph) => total + layout.share[graph], 0);

  /** Moves the border of two graphs by a part of the height of all. */
  const resize = (from: GraphLayout, above: GraphName, below: GraphName, part: number) => {
    const by = Math.max(LEAST_SHARE - from.share[above], Math.min(from.share[below] - LEAST_SHARE, part * sum));
    onLayout({
      ...from,
      share: { ...from.share, [above]: from.share[above] + by, [below]: from.share[below] - by },
    });
  };
  const bar = (above: GraphName, below: GraphName) => ({
    onPointerDown: (event: PointerEvent) => {
      event.currentTarget.setPointerCapture(event.pointerId);
      resized.current = { above, below, y: event.clientY, layout };
    },
    onPointerMove: (event: PointerEvent) => {
      const now = resized.current;
      const height = frame.current?.clientHeight ?? 0;
      if (now && height > 0) resize(now.layout, now.above, now.below, (event.clientY - now.y) / height);
    },
    onPointerUp: () => {
      resized.current = null;
    },
    onPointerCancel: () => {
      resized.current = null;
    },
    onKeyDown: (event: KeyboardEvent) => {
      if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
      event.preventDefault();
      resize(layout, above, below, (event.key === 'ArrowUp' ? -KEY_SHARE : KEY_SHARE) / 2);
    },
    onDoubleClick: () => onLayout({ ...layout, share: { y: 2, v: 1, a: 1, j: 1 } }),
  });

  return (
    <div className={styles.graphs}>
      <div ref={frame} className={styles.stack}>
        {GRAPHS.map((graph) => {
          const name = t(`cam.graph.${graph}`);
          if (layout.closed[graph])
            return (
              <button
                key={graph}
                type="button"
                className={styles.closed}
                data-curve={graph}
                onClick={() => onLayout({ ...layout, closed: { ...layout.closed, [graph]: false } })}
              >
                <ChevronRight size={14} aria-hidden />
                {name}
              </button>
            );
          const below = open[open.indexOf(graph) + 1];
          return (
            <Fragment key={graph}>
              <div className={styles.slot} style={{ flexGrow: layout.share[graph] }}>
                <Graph
                  edit={edit}
                  graph={graph}
                  tool={tool}
                  window={window}
                  onWindow={(next) => onLayout({ ...layout, window: next })}
                  onClose={() => onLayout({ ...layout, closed: { ...layout.closed, [graph]: true } })}
                  onTool={onTool}
                />
              </div>
              {below && (
                <div
                  className={styles.bar}
                  role="separator"
                  aria-orientation="horizontal"
                  aria-label={t('cam.separator', { above: name, below: t(`cam.graph.${below}`) })}
                  aria-valuenow={Math.round((layout.share[graph] / sum) * 100)}
                  aria-valuemin={0}
                  aria-valuemax={100}
                  tabIndex={0}
                  {...bar(graph, below)}
                />
              )}
            </Fragment>
          );
        })}
      </div>
      <MasterAxis window={window} title={t('cam.master')} />
    </div>
  );
}

/** The positions of the master below graphs and tracks. */
export function MasterAxis({ window, title }: { window: Range; title: string }) {
  const frame = useRef<HTMLDivElement>(null);
  const { width } = useSize(frame);
  const plot = Math.max(1, width - MARGIN_LEFT - MARGIN_RIGHT);
  const count = plot / X_TICK_PX;
  const step = niceStep(window, count);
  return (
    <div ref={frame} className={styles.master} aria-hidden>
      <span>{title}</span>
      <svg width={width} height={20}>
        {ticks(window, count).map((x) => (
          <text
            key={x}
            className={styles.tick}
            x={MARGIN_LEFT + ((x - window.min) / (window.max - window.min)) * plot}
            y={10}
            textAnchor="middle"
            dominantBaseline="central"
          >
            {tickText(x, step)}
          </text>
        ))}
      </svg>
    </div>
  );
}
