import 'uplot/dist/uPlot.min.css';
import { useEffect, useMemo, useRef, useState, type CSSProperties, type PointerEvent, type ReactNode } from 'react';
import type { Range } from '@/editors/plot/scales';
import { useSize } from '@/editors/plot/useSize';
import { usePreferences } from '@/session/preferences';
import type { Tool } from '../traceView';
import type { DiagramModel } from './diagrams';
import { themeInk } from './ink';
import { DiagramPlot, type Picture } from './plot';
import { momentText, timeGrain } from './timeAxis';
import styles from '../Trace.module.css';

/** Pixels that the pointer may be off a cursor line. */
const NEAR_PX = 6;
/** A smaller box is a click. */
const LEAST_BOX_PX = 6;

export interface DiagramActs {
  /** Zooms time or values around a place of it; `factor` below 1 shows less. */
  zoom: (axis: 'x' | 'y', at: number, factor: number) => void;
  /** Scrolled by parts of what was seen when the drag began; `begins` with its first step. */
  drag: (partX: number, partY: number, begins: boolean) => void;
  box: (x: Range, y: Range) => void;
  reset: () => void;
  cursor: (number: number, ns: number) => void;
  hover: (ns: number | null) => void;
  select: () => void;
}

interface DiagramProps {
  diagram: DiagramModel;
  picture: Picture;
  withTime: boolean;
  tool: Tool;
  cursors: readonly number[];
  selected: boolean;
  acts: DiagramActs;
  legend: ReactNode;
  label: string;
}

interface Box {
  from: { x: number; y: number };
  to: { x: number; y: number };
}

type Drag =
  | { kind: 'scroll'; x: number; y: number; moved: boolean }
  | { kind: 'box'; x: number; y: number }
  | { kind: 'cursor'; number: number };

/** One diagram: curves over the time, with what the pointer does in it. */
export function Diagram(props: DiagramProps) {
  const { diagram, picture, withTime, tool, cursors, selected, acts, legend, label } = props;
  const place = useRef<HTMLDivElement>(null);
  const plot = useRef<DiagramPlot | null>(null);
  const drag = useRef<Drag | null>(null);
  const [box, setBox] = useState<Box | null>(null);
  const [area, setArea] = useState({ left: 0, top: 0, width: 0, height: 0 });
  const theme = usePreferences((state) => state.shown);
  const { width, height } = useSize(place);
  const sized = width > 40 && height > 30;
  const look = useMemo(() => JSON.stringify([diagram.appearance, [...diagram.y]]), [diagram]);
  const latest = useRef({ picture, acts });
  useEffect(() => {
    latest.current = { picture, acts };
  });

  useEffect(() => {
    if (!sized || !place.current) return;
    const { width: w, height: h } = place.current.getBoundingClientRect();
    const [appearance, y] = JSON.parse(look) as [DiagramModel['appearance'], [number, never][]];
    const style = { x: appearance.x, y: new Map(y), fontSize: appearance.font_size, withTime };
    const made = new DiagramPlot(place.current, { width: w, height: h }, style, themeInk());
    plot.current = made;
    made.draw(latest.current.picture);
    setArea(made.area);
    return () => {
      plot.current = null;
      made.destroy();
    };
  }, [look, withTime, theme, sized]);

  useEffect(() => {
    if (!plot.current || !sized) return;
    plot.current.resize({ width, height });
    setArea(plot.current.area);
  }, [width, height, sized]);

  useEffect(() => {
    plot.current?.draw(picture);
  }, [picture]);

  // React listens to wheels passively: the page would scroll, too.
  useEffect(() => {
    const frame = place.current;
    if (!frame) return;
    const onWheel = (event: WheelEvent) => {
      if (!plot.current) return;
      event.preventDefault();
      const at = within(frame, event);
      const factor = Math.exp(Math.max(-0.6, Math.min(0.6, event.deltaY * 0.0022)));
      const [axis] = diagram.y.keys();
      const onValues = event.ctrlKey || event.metaKey || at.x < plot.current.area.left;
      if (onValues) latest.current.acts.zoom('y', plot.current.valueAt(at.y, axis ?? 0), factor);
      else latest.current.acts.zoom('x', plot.current.momentAt(at.x), factor);
    };
    frame.addEventListener('wheel', onWheel, { passive: false });
    return () => frame.removeEventListener('wheel', onWheel);
  }, [diagram]);

  const acrossOf = (ns: number) => {
    const part = (ns - picture.x.min) / (picture.x.max - picture.x.min);
    return area.left + (diagram.appearance.x.reverse ? 1 - part : part) * area.width;
  };
  const cursorAt = (x: number) => {
    const near = cursors.map((ns, number) => ({ number, off: Math.abs(acrossOf(ns) - x) }));
    return near.filter(({ off }) => off <= NEAR_PX).sort((one, other) => one.off - other.off)[0]?.number;
  };

  const onPointerDown = (event: PointerEvent<HTMLDivElement>) => {
    acts.select();
    if (event.button !== 0 || !plot.current) return;
    const at = within(event.currentTarget, event);
    event.currentTarget.setPointerCapture(event.pointerId);
    const cursor = cursorAt(at.x);
    if (cursor !== undefined) drag.current = { kind: 'cursor', number: cursor };
    else if ((tool === 'zoom') !== event.shiftKey) drag.current = { kind: 'box', ...at };
    else drag.current = { kind: 'scroll', ...at, moved: false };
  };
  const onPointerMove = (event: PointerEvent<HTMLDivElement>) => {
    if (!plot.current) return;
    const at = within(event.currentTarget, event);
    const moment = plot.current.momentAt(at.x);
    acts.hover(moment);
    const own = drag.current;
    if (own === null) return;
    if (own.kind === 'cursor') acts.cursor(own.number, moment);
    else if (own.kind === 'box') setBox({ from: { x: own.x, y: own.y }, to: at });
    else {
      const sign = diagram.appearance.x.reverse ? -1 : 1;
      const [axis] = diagram.y.values();
      const up = axis?.reverse ? -1 : 1;
      acts.drag((sign * (own.x - at.x)) / area.width, (up * (at.y - own.y)) / area.height, !own.moved);
      own.moved = true;
    }
  };
  const onPointerUp = () => {
    const own = drag.current;
    drag.current = null;
    setBox(null);
    if (own?.kind !== 'box' || box === null || !plot.current) return;
    const { from, to } = box;
    if (Math.abs(from.x - to.x) < LEAST_BOX_PX) return;
    const [axis] = diagram.y.keys();
    const values = [from.y, to.y].map((y) => plot.current!.valueAt(y, axis ?? 0));
    const times = [from.x, to.x].map((x) => plot.current!.momentAt(x));
    acts.box(rangeOf(times), rangeOf(values));
  };
  const grain = timeGrain(picture.x.max - picture.x.min);
  const background = selected ? diagram.appearance.selected_background : diagram.appearance.background;
  return (
    <figure
      className={styles.diagram}
      data-diagram={diagram.key}
      data-selected={selected || undefined}
      style={background ? ({ '--diagram-bg': background } as CSSProperties) : undefined}
      aria-label={label}
    >
      <figcaption className={styles.legend}>{legend}</figcaption>
      <div
        className={styles.canvas}
        data-tool={tool}
        onPointerDown={onPointerDown}
        onPointerMove={onPointerMove}
        onPointerUp={onPointerUp}
        onPointerCancel={onPointerUp}
        onPointerLeave={() => acts.hover(null)}
        onDoubleClick={acts.reset}
      >
        <div ref={place} className={styles.plot} aria-hidden />
        {cursors.map((ns, number) => {
          const x = acrossOf(ns);
          if (x < area.left - 1 || x > area.left + area.width + 1) return null;
          return (
            <div
              key={number}
              className={styles.cursor}
              data-cursor={number + 1}
              style={{ left: x, top: area.top, height: area.height }}
            >
              <span>{momentText(ns, grain)}</span>
            </div>
          );
        })}
        {box && (
          <div
            className={styles.box}
            style={{
              left: Math.min(box.from.x, box.to.x),
              top: Math.min(box.from.y, box.to.y),
              width: Math.abs(box.from.x - box.to.x),
              height: Math.abs(box.from.y - box.to.y),
            }}
          />
        )}
        <AxisTexts diagram={diagram} area={area} />
      </div>
    </figure>
  );
}

/** The descriptions of both axes: above the Y axis, and at the end of the time axis (TRC-56). */
function AxisTexts({ diagram, area }: { diagram: DiagramModel; area: { left: number; width: number } }) {
  const [y] = diagram.y.values();
  const x = diagram.appearance.x;
  return (
    <>
      {y?.description && (
        <span className={styles.yText} style={{ left: area.left + 6 }}>
          {y.description}
        </span>
      )}
      {x.description && <span className={styles.xText}>{x.description}</span>}
    </>
  );
}

const rangeOf = (ends: readonly number[]): Range => ({ min: Math.min(...ends), max: Math.max(...ends) });

function within(element: Element, event: { clientX: number; clientY: number }): { x: number; y: number } {
  const { left, top } = element.getBoundingClientRect();
  return { x: event.clientX - left, y: event.clientY - top };
}
