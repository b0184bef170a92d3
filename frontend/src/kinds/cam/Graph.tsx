import { X } from 'lucide-react';
import { useEffect, useMemo, useRef, useState, type KeyboardEvent, type MouseEvent, type PointerEvent } from 'react';
import { useText } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import { IconButton } from '@/ui/Button';
import { domainOf, segmentAt } from './camTable';
import styles from './Cam.module.css';
import type { CamEdit, Tool } from './edit';
import { insertAt, nudged, removed, stepped, type Nudge } from './keyActs';
import { GraphCurves } from './GraphCurves';
import { PlotGrid } from './PlotGrid';
import { RunMarks } from './RunMarks';
import {
  acrossOf,
  downOf,
  drawnPoints,
  type GraphName,
  MARGIN_LEFT,
  MARGIN_RIGHT,
  niceStep,
  type Range,
  snapped,
  snapStep,
  ticks,
  valueOnCurve,
  valueRange,
  zoomed,
} from './plot';
import { useGraphDrag, type Place } from './useGraphDrag';
import { useSize } from '@/editors/plot/useSize';

export const TITLE_HEIGHT = 24;
const X_TICK_PX = 90;
const Y_TICK_PX = 24;
/** How near the pointer must be to a point or a curve, in pixels. */
const NEAR = 8;

interface GraphProps {
  edit: CamEdit;
  graph: GraphName;
  tool: Tool;
  window: Range;
  onWindow: (window: Range | null) => void;
  onClose: () => void;
  onTool: (tool: Tool) => void;
}

/** One of the four graphs of a cam over the master (CAM-30 to CAM-37). */
export function Graph({ edit, graph, tool, window, onWindow, onClose, onTool }: GraphProps) {
  const t = useText();
  const { cam, drawing, selected, locked } = edit;
  const frame = useRef<HTMLDivElement>(null);
  const { width, height } = useSize(frame);
  const [pointer, setPointer] = useState<{ at: Place; left: number; top: number } | null>(null);
  const whole = useMemo((): Range => {
    const [min, max] = domainOf(cam);
    return { min, max };
  }, [cam]);
  const plot = { width: Math.max(1, width - MARGIN_LEFT - MARGIN_RIGHT), height: Math.max(1, height) };
  const found = useMemo(() => valueRange(cam, drawing, graph), [cam, drawing, graph]);
  const [held, setHeld] = useState<Range | null>(null);
  const values = held ?? found;
  const px = (x: number) => MARGIN_LEFT + acrossOf(x, window, plot.width);
  const py = (value: number) => downOf(value, values, plot.height);
  const counts = { x: plot.width / X_TICK_PX, value: plot.height / Y_TICK_PX };
  const steps = { x: snapStep(window, counts.x), value: snapStep(values, counts.value) };
  const placeAt = (event: { clientX: number; clientY: number }, by: Range): Place => {
    const box = frame.current!.getBoundingClientRect();
    return {
      x: window.min + ((event.clientX - box.left - MARGIN_LEFT) / plot.width) * (window.max - window.min),
      value: by.max - ((event.clientY - box.top) / plot.height) * (by.max - by.min),
    };
  };
  const drag = useGraphDrag({
    edit,
    graph,
    values,
    placeAt,
    steps,
    pan: (pixels) => {
      const by = (pixels / plot.width) * (window.max - window.min);
      onWindow(zoomed({ min: window.min + by, max: window.max + by }, whole, window.min + by, 1));
    },
  });
  const spaceDown = useRef(false);
  const editable = graph !== 'j' && !locked;

  const pointNear = (event: { clientX: number; clientY: number }): number | null => {
    if (graph === 'j') return null;
    const box = frame.current!.getBoundingClientRect();
    let best: number | null = null;
    let distance = NEAR;
    cam.points.forEach((point, index) => {
      const away = Math.hypot(event.clientX - box.left - px(point.x), event.clientY - box.top - py(point[graph]));
      if (away <= distance) [best, distance] = [index, away];
    });
    return best;
  };
  const segmentNear = (event: { clientX: number; clientY: number }): number | null => {
    const { x } = placeAt(event, values);
    if (x < whole.min || x > whole.max || drawing === null) return null;
    const segment = segmentAt(cam, x);
    const curve = drawing.segments[segment];
    if (!curve) return null;
    const box = frame.current!.getBoundingClientRect();
    const [left, top] = [event.clientX - box.left, event.clientY - box.top];
    const near = curve.x.some((at, index) => {
      if (index === 0) return false;
      return (
        distanceTo(
          left,
          top,
          px(curve.x[index - 1]!),
          py(curve[graph][index - 1]!),
          px(at),
          py(curve[graph][index]!),
        ) <= NEAR
      );
    });
    return near ? segment : null;
  };

  const onPointerDown = (event: PointerEvent) => {
    if (event.button === 1 || spaceDown.current) {
      event.preventDefault();
      drag.begin(event, 'pan', 0);
      return;
    }
    if (event.button !== 0) return;
    const at = placeAt(event, values);
    if (tool === 'add' && editable && at.x > whole.min && at.x < whole.max) {
      void insertAt(edit, snapped(at.x, steps.x), graph, snapped(at.value, steps.value));
      return;
    }
    const point = pointNear(event);
    if (point !== null) {
      edit.select({ kind: 'point', index: point });
      setHeld(values);
      drag.begin(event, 'point', point);
      return;
    }
    const segment = segmentNear(event);
    edit.select(segment === null ? null : { kind: 'segment', index: segment });
    if (segment !== null) {
      setHeld(values);
      drag.begin(event, 'segment', segment);
    }
  };
  const onPointerMove = (event: PointerEvent) => {
    const box = frame.current!.getBoundingClientRect();
    setPointer({ at: placeAt(event, values), left: event.clientX - box.left, top: event.clientY - box.top });
    drag.move(event);
  };
  const finish = (taken: boolean) => {
    drag.end(taken);
    setHeld(null);
  };
  const onDoubleClick = (event: MouseEvent) => {
    if (tool === 'select' && pointNear(event) === null) onWindow(null);
  };
  // The wheel must not scroll the page as well, which only a listener that is not passive can prevent.
  const zoom = useRef((_: WheelEvent) => {});
  useEffect(() => {
    zoom.current = (event) => {
      event.preventDefault();
      const about = Math.min(window.max, Math.max(window.min, placeAt(event, values).x));
      const next = zoomed(window, whole, about, Math.exp(event.deltaY * 0.0015));
      onWindow(next.max - next.min >= whole.max - whole.min ? null : next);
    };
  });
  useEffect(() => {
    const element = frame.current;
    const listener = (event: WheelEvent) => zoom.current(event);
    element?.addEventListener('wheel', listener, { passive: false });
    return () => element?.removeEventListener('wheel', listener);
  }, []);

  const onKeyDown = (event: KeyboardEvent) => {
    if (event.target !== event.currentTarget) return;
    const used = () => {
      event.preventDefault();
      event.stopPropagation();
    };
    const arrows: Partial<Record<string, Nudge>> = {
      ArrowLeft: { x: -1, value: 0 },
      ArrowRight: { x: 1, value: 0 },
      ArrowUp: { x: 0, value: 1 },
      ArrowDown: { x: 0, value: -1 },
    };
    const arrow = arrows[event.key];
    if (event.key === ' ') {
      spaceDown.current = true;
      used();
    } else if (event.key === 'Escape') {
      if (drag.active()) finish(false);
      else if (tool === 'add') onTool('select');
      else edit.select(null);
      used();
    } else if (arrow && event.ctrlKey && editable) {
      nudged(edit, graph, arrow, steps, event.shiftKey ? 10 : 1);
      used();
    } else if (arrow && !event.ctrlKey && arrow.x !== 0) {
      stepped(edit, arrow.x);
      used();
    } else if (event.key === 'Delete' && !locked) {
      removed(edit);
      used();
    } else if (event.key === 'Insert' && !locked) {
      void insertAt(edit, null, 'y', null);
      used();
    } else if (event.key === '+' || event.key === '-') {
      onWindow(zoomed(window, whole, (window.min + window.max) / 2, event.key === '+' ? 0.8 : 1.25));
      used();
    } else if (event.key === '0') {
      onWindow(null);
      used();
    }
  };

  const chosenPoint = selected?.kind === 'point' ? selected.index : null;
  const drawn = useMemo(
    () =>
      drawnPoints(
        cam.points.map((point) => point.x),
        window,
        plot.width,
        chosenPoint,
      ),
    [cam.points, window, plot.width, chosenPoint],
  );
  const stepX = niceStep(window, counts.x);
  const stepValue = niceStep(values, counts.value);
  const name = t(`cam.graph.${graph}`);
  const marked = chosenPoint === null ? undefined : cam.points[chosenPoint];
  const told = held !== null && marked && graph !== 'j' ? { x: marked.x, value: marked[graph] } : pointer?.at;
  return (
    <div
      ref={frame}
      className={styles.graph}
      data-graph={graph}
      data-tool={tool === 'add' && editable ? 'add' : undefined}
      role="application"
      aria-roledescription={t('cam.graphRole')}
      aria-label={t('cam.graphLabel', { graph: name })}
      tabIndex={0}
      onKeyDown={onKeyDown}
      onKeyUp={(event) => {
        if (event.key === ' ') spaceDown.current = false;
      }}
      onBlur={() => {
        spaceDown.current = false;
      }}
      onPointerDown={onPointerDown}
      onPointerMove={onPointerMove}
      onPointerUp={() => finish(true)}
      onPointerCancel={() => finish(false)}
      onPointerLeave={() => setPointer(null)}
      onDoubleClick={onDoubleClick}
    >
      <svg width={width} height={height} aria-hidden>
        <clipPath id={`clip-${graph}`}>
          <rect x={MARGIN_LEFT} y={0} width={plot.width} height={plot.height} />
        </clipPath>
        <PlotGrid
          left={MARGIN_LEFT}
          right={MARGIN_LEFT + plot.width}
          height={plot.height}
          values={values}
          py={py}
          count={counts.value}
          title={TITLE_HEIGHT}
          upright={ticks(window, counts.x).map(px)}
        />
        <g clipPath={`url(#clip-${graph})`}>
          {drawn.map((index) => {
            const left = px(cam.points[index]!.x);
            return <line key={index} className={styles.border} x1={left} x2={left} y1={0} y2={plot.height} />;
          })}
          {drawing && (
            <GraphCurves
              drawing={drawing}
              graph={graph}
              selected={selected?.kind === 'segment' ? selected.index : null}
              window={window}
              values={values}
              width={plot.width}
              height={plot.height}
            />
          )}
          {edit.running && (
            <RunMarks
              {...edit.running}
              window={window}
              width={plot.width}
              height={plot.height}
              down={(x, y) => {
                // The slave is where the application has it; derivatives are those of the curve that is shown.
                const value = graph === 'y' ? y : drawing && valueOnCurve(drawing, graph, x);
                return value === null ? null : py(value);
              }}
            />
          )}
        </g>
        {graph !== 'j' &&
          drawn.map((index) => (
            <circle
              key={index}
              className={styles.point}
              data-curve={graph}
              data-point={index}
              data-selected={index === chosenPoint || undefined}
              cx={px(cam.points[index]!.x)}
              cy={py(cam.points[index]![graph])}
              r={index === chosenPoint ? 5 : 3.5}
            />
          ))}
      </svg>
      <div className={styles.graphHead}>
        <IconButton icon={X} small label={t('cam.closeGraph', { graph: name })} onClick={onClose} />
        <span data-curve={graph}>{name}</span>
      </div>
      {pointer && told && (
        <div
          className={styles.readout}
          style={{
            left: Math.min(pointer.left + 14, Math.max(0, width - 170)),
            top: Math.max(2, Math.min(pointer.top + 14, height - 24)),
          }}
        >
          {`X ${numberText(snapped(told.x, stepX / 100))}  ${graph.toUpperCase()} ${numberText(snapped(told.value, stepValue / 100))}`}
        </div>
      )}
    </div>
  );
}

/** Distance of a point from a line between two others. */
function distanceTo(x: number, y: number, x0: number, y0: number, x1: number, y1: number): number {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const length = dx * dx + dy * dy;
  const part = length === 0 ? 0 : Math.max(0, Math.min(1, ((x - x0) * dx + (y - y0) * dy) / length));
  return Math.hypot(x - x0 - part * dx, y - y0 - part * dy);
}
