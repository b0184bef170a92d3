import { useCallback, useEffect, useMemo, useRef, useState, type KeyboardEvent } from 'react';
import { createStore, useStore, type StoreApi } from 'zustand';
import type { Range } from '@/editors/plot/scales';
import { useSize } from '@/editors/plot/useSize';
import { useText } from '@/i18n';
import { usePreferences } from '@/session/preferences';
import { formatNumber } from './numbers';
import { nearestSample, valueAt } from './analysis/statistics';
import { channelName, recordedSpan, type TraceData } from './configuration';
import { valueRange } from './data/curves';
import type { RunData } from './data/runData';
import { Diagram, type DiagramActs } from './diagram/Diagram';
import { diagramsOf, rowsOf, type DiagramModel } from './diagram/diagrams';
import { automaticColor, canvasColors } from './diagram/ink';
import type { Layer, Picture } from './diagram/plot';
import { timeRange, valueScale } from './diagram/scaling';
import { around, compressed, replaced, scrolled, shown, stretched, zoomed, type View } from './diagram/viewport';
import { momentText, timeGrain } from './diagram/timeAxis';
import type { TraceView } from './traceView';
import styles from './Trace.module.css';

/** A part of what is seen that one key scrolls. */
const KEY_PART = 0.1;

/** A run that is drawn over another one. */
export interface OverlayRun {
  run: RunData;
  title: string;
  shift: number;
  /** Differs when other samples are there. */
  drawn: number;
}

interface DiagramsProps {
  data: TraceData;
  run: RunData | null;
  overlays: readonly OverlayRun[];
  /** The buffer is filled again and again: the time axis follows it. */
  live: boolean;
  view: TraceView;
  onView: (change: (view: TraceView) => TraceView) => void;
}

/** The time that is seen: what was zoomed to, or the rule of the first record. */
export function seenTime(data: TraceData, run: RunData | null, live: boolean, zoomedTo: Range | null): Range {
  if (zoomedTo !== null) return zoomedTo;
  const [record] = data.records;
  if (record === undefined) return { min: 0, max: 1e9 };
  const extent = around(data.records.map((one, at) => extentOf(run, one.name, at)));
  return timeRange(record.appearance.x, extent, live ? recordedSpan(record, intervalOf(run, record.name)) : 0);
}

function extentOf(run: RunData | null, name: string, at: number): Range | null {
  const own = run?.recordOf(name, at) ?? null;
  return own === null || run === null ? null : run.extent(own);
}
/** Distance of two samples comes with the factor of the record already. */
function intervalOf(run: RunData | null, name: string): number {
  const own = run?.recordOf(name, 0) ?? null;
  if (run === null || own === null) return 10e6;
  const every = run.shape.data.records[own]?.every ?? 1;
  return run.interval(own) / every;
}

/** All diagrams of a trace, and what keys and pointer do in them (TRC-75 to TRC-80). */
export function Diagrams({ data, run, overlays, live, view, onView }: DiagramsProps) {
  const t = useText();
  const frame = useRef<HTMLDivElement>(null);
  const { width } = useSize(frame);
  const [pointer] = useState(() => createStore<Pointer>(() => ({ ns: null })));
  const diagrams = useMemo(() => diagramsOf(data, view.multi, view.computed), [data, view.multi, view.computed]);
  const oneColumn = view.multi || data.stacked || view.computed.length > 0;
  const rows = useMemo(() => rowsOf(diagrams, oneColumn), [diagrams, oneColumn]);
  const { min, max } = seenTime(data, run, live, view.views.now.x);
  const x = useMemo(() => ({ min, max }), [min, max]);
  const theme = usePreferences((state) => state.shown);
  const scales = view.views.now.y;
  const drawn = run?.snapshot() ?? 0;
  // Made anew only when what is in them may be another: a pointer that moves draws nothing.
  const pictures = useMemo(() => {
    const sources = { data, run, overlays, drawn, colors: canvasColors(), theme };
    return new Map(
      rows.flatMap((row) => row.map((one) => [one.key, pictureOf(one, sources, scales, x, width / row.length)])),
    );
  }, [rows, data, run, overlays, drawn, theme, scales, x, width]);
  const latest = useRef({ x, pictures, start: view.views.now });
  useEffect(() => {
    latest.current.x = x;
    latest.current.pictures = pictures;
  });

  const change = useCallback(
    (of: (now: View) => View, step: 'new' | 'same' = 'new') =>
      onView((before) => ({
        ...before,
        views: (step === 'new' ? shown : replaced)(before.views, of(before.views.now)),
      })),
    [onView],
  );
  const valuesOf = (key: string): Range => pictureRange(latest.current.pictures.get(key));
  const withValues = (now: View, key: string, range: Range): View => ({ ...now, y: { ...now.y, [key]: range } });
  const wheel = useRef({ key: '', at: 0 });
  const actsOf = (diagram: DiagramModel): DiagramActs => ({
    zoom: (axis, at, factor) => {
      // Turns of the wheel that follow each other are one step of the way back.
      const step =
        wheel.current.key === axis + diagram.key && performance.now() - wheel.current.at < 600 ? 'same' : 'new';
      wheel.current = { key: axis + diagram.key, at: performance.now() };
      if (axis === 'x') change((now) => ({ ...now, x: zoomed(latest.current.x, at, factor, 100) }), step);
      else change((now) => withValues(now, diagram.key, zoomed(valuesOf(diagram.key), at, factor)), step);
    },
    drag: (partX, partY, begins) => {
      if (begins)
        latest.current.start = {
          x: latest.current.x,
          y: { ...view.views.now.y, [diagram.key]: valuesOf(diagram.key) },
        };
      const { start } = latest.current;
      change(
        (now) => {
          const moved = { ...now, x: scrolled(start.x ?? latest.current.x, partX) };
          // A slip of the hand does not take the values out of their scale.
          return Math.abs(partY) < 0.02 && now.y[diagram.key] === undefined
            ? moved
            : withValues(moved, diagram.key, scrolled(start.y[diagram.key] ?? valuesOf(diagram.key), partY));
        },
        begins ? 'new' : 'same',
      );
    },
    box: (boxX, boxY) => change((now) => withValues({ ...now, x: boxX }, diagram.key, boxY)),
    reset: () => change(() => ({ x: null, y: {} })),
    cursor: (number, ns) =>
      onView((before) => ({ ...before, cursors: before.cursors.map((one, at) => (at === number ? ns : one)) })),
    hover: (ns) => pointer.setState({ ns }),
    select: () => onView((before) => (before.diagram === diagram.key ? before : { ...before, diagram: diagram.key })),
  });

  const onKeyDown = (event: KeyboardEvent) => {
    const active = diagrams.find(({ key }) => key === view.diagram) ?? diagrams[0];
    if (active === undefined) return;
    const scrollValues = (part: number) => {
      const keys = event.ctrlKey ? diagrams.map(({ key }) => key) : [active.key];
      change((now) => keys.reduce((made, key) => withValues(made, key, scrolled(valuesOf(key), part)), now));
    };
    const acts: Record<string, () => void> = {
      ArrowUp: () => scrollValues(KEY_PART),
      ArrowDown: () => scrollValues(-KEY_PART),
      ArrowLeft: () => sideways(-1),
      ArrowRight: () => sideways(1),
      '+': () => change((now) => ({ ...now, x: stretched(latest.current.x) })),
      '-': () => change((now) => ({ ...now, x: compressed(latest.current.x) })),
      '0': () => change(() => ({ x: null, y: {} })),
    };
    const sideways = (sign: number) => {
      if (event.altKey || view.cursors.length === 0)
        change((now) => ({ ...now, x: scrolled(latest.current.x, sign * KEY_PART) }));
      else moveCursor(sign, event.shiftKey ? 10 : 1);
    };
    const moveCursor = (sign: number, by: number) => {
      const number = view.cursors.length - 1;
      const time = pictures.get(active.key)?.layers[0]?.curves.time;
      const near = time && nearestSample(time, view.cursors[number]!);
      if (time == null || near == null) return;
      actsOf(active).cursor(number, time[Math.max(0, Math.min(time.length - 1, near + sign * by))]!);
    };
    const act = acts[event.key];
    if (act === undefined || (event.ctrlKey && !event.key.startsWith('Arrow'))) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  };

  const grain = timeGrain(x.max - x.min);
  const apart = view.cursors.length === 2 ? view.cursors[1]! - view.cursors[0]! : null;
  return (
    <div className={styles.diagrams}>
      <div
        ref={frame}
        className={styles.rows}
        data-multi={view.multi || undefined}
        tabIndex={0}
        role="group"
        aria-label={t('trace.diagrams')}
        onKeyDown={onKeyDown}
      >
        {rows.map((row, number) => (
          <div key={row[0]!.key} className={styles.row}>
            {row.map((diagram) => (
              <Diagram
                key={diagram.key}
                diagram={diagram}
                picture={pictures.get(diagram.key)!}
                withTime={!view.multi || number === rows.length - 1 || view.computed.length > 0}
                tool={view.tool}
                cursors={view.cursors}
                selected={diagrams.length > 1 && diagram.key === view.diagram}
                acts={actsOf(diagram)}
                label={t('trace.diagram', { name: titleOf(diagram, t) })}
                legend={
                  <Legend
                    diagram={diagram}
                    data={data}
                    picture={pictures.get(diagram.key)!}
                    pointer={pointer}
                    cursor={view.cursors[0] ?? null}
                  />
                }
              />
            ))}
          </div>
        ))}
      </div>
      <output className={`${styles.time} code`} aria-label={t('trace.time')}>
        <PointerTime pointer={pointer} cursors={view.cursors} grain={grain} />
        {apart !== null && ` (Δ ${momentText(Math.abs(apart), grain)})`}
      </output>
    </div>
  );
}

/** Where the pointer is; by a store of its own, as it moves with every picture. */
interface Pointer {
  ns: number | null;
}

function PointerTime({
  pointer,
  cursors,
  grain,
}: {
  pointer: StoreApi<Pointer>;
  cursors: readonly number[];
  grain: number;
}) {
  const t = useText();
  const ns = useStore(pointer, (state) => state.ns);
  const moments = ns === null ? cursors : [ns];
  return moments.map((one) => t('trace.timeAt', { time: momentText(one, grain) })).join(' – ');
}

type Texts = ReturnType<typeof useText>;
const titleOf = (diagram: DiagramModel, t: Texts): string =>
  diagram.computed ? t(`trace.${diagram.computed.operation}Of`, { name: diagram.title }) : diagram.title;

interface Sources {
  data: TraceData;
  run: RunData | null;
  overlays: readonly OverlayRun[];
  /** Which samples are there, and which colours. */
  drawn: number;
  theme: 'light' | 'dark';
  colors: (color: string) => string;
}

/** What is drawn in a diagram: curves by their colours, and what is computed or another run dashed. */
function pictureOf(
  diagram: DiagramModel,
  { data, run, overlays, colors }: Sources,
  scales: View['y'],
  x: Range,
  width: number,
): Picture {
  const record = data.records[diagram.record]!;
  const layers: Layer[] = [];
  const pixels = Math.max(50, width);
  const add = (from: RunData, shift: number, over: boolean) => {
    const own = from.recordOf(record.name, diagram.record);
    if (own === null) return;
    const moved = { min: x.min - shift, max: x.max - shift };
    for (const k of diagram.channels) {
      const channel = record.channels[k]!;
      const found = from.curve(own, channel, moved, pixels, diagram.computed?.operation);
      if (found === null) continue;
      const color = colors(channel.color || automaticColor(k));
      layers.push({
        channel: k,
        curve: found.curve,
        curves: shift === 0 ? found.curves : { ...found.curves, time: found.curves.time.map((ns) => ns + shift) },
        axis: diagram.computed ? 0 : channel.axis,
        look: {
          color,
          graph: diagram.computed && channel.graph !== 'none' ? 'line' : channel.graph,
          minimum: diagram.computed ? null : channel.minimum_warning,
          maximum: diagram.computed ? null : channel.maximum_warning,
          width: 1.4,
          dashed: over,
        },
      });
    }
  };
  for (const overlay of overlays) add(overlay.run, overlay.shift, true);
  if (run) add(run, 0, false);
  const zoomedTo = scales[diagram.key];
  const y = new Map(
    [...diagram.y].map(([number, axis], place) => {
      const ranges = layers
        .filter((layer) => layer.axis === number)
        .map(({ curves, curve }) => valueRange({ ...curves, channels: new Map([[0, curve]]) }, 0, x));
      const range = valueScale(axis, around(ranges));
      return [number, place === 0 && zoomedTo ? zoomedTo : range] as const;
    }),
  );
  const own = run?.recordOf(record.name, diagram.record) ?? null;
  return { x, y, layers, trigger: own === null ? null : (run?.trigger(own) ?? null) };
}

function pictureRange(picture: Picture | undefined): Range {
  const [range] = picture?.y.values() ?? [];
  return range ?? { min: 0, max: 1 };
}

/** Names of the curves with their values at the pointer or the first cursor. */
function Legend({
  diagram,
  data,
  picture,
  pointer,
  cursor,
}: {
  diagram: DiagramModel;
  data: TraceData;
  picture: Picture;
  pointer: StoreApi<Pointer>;
  cursor: number | null;
}) {
  const t = useText();
  const at = useStore(pointer, (state) => state.ns) ?? cursor;
  const record = data.records[diagram.record]!;
  const own = picture.layers.filter(({ look }) => !look.dashed);
  return (
    <>
      {(data.records.length > 1 || diagram.computed !== null) && <b>{titleOf(diagram, t)}</b>}
      {diagram.channels.map((k) => {
        const layer = own.find(({ channel }) => channel === k);
        const last = layer?.curves.time.at(-1) ?? -Infinity;
        const value = at === null || !layer || at > last ? null : valueAt(layer.curves.time, layer.curve.low, at);
        return (
          <span key={k}>
            <i style={{ background: record.channels[k]!.color || automaticColor(k) }} />
            {channelName(record.channels[k]!)}
            {value !== null && <output className="code">{formatNumber(value)}</output>}
          </span>
        );
      })}
    </>
  );
}
