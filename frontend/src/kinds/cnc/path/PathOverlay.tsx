import { useState, type PointerEvent } from 'react';
import { useText } from '@/i18n';
import type { PathElement, PathSummary } from './pathView';
import styles from './Path.module.css';
import { pixelSize, plus, seenAt, type Eye, type Frame, type Seen, type Vector } from './projection';

/** What is dragged: the end of the element of a line, or one of its tangents. */
export type Grip =
  | { readonly kind: 'end'; readonly line: number; readonly from: Vector }
  | {
      readonly kind: 'tangent';
      readonly line: number;
      readonly from: Vector;
      readonly at: 'start' | 'end';
      readonly end: Vector;
    };

interface PathOverlayProps {
  eye: Eye;
  frame: Frame;
  summary: PathSummary;
  chosen: readonly PathElement[];
  line: number | null;
  /** Ends that can be dragged, by line. */
  movable: (line: number) => boolean;
  tangents: (line: number) => boolean;
  tool: Vector | null;
  trace: readonly Vector[];
  onChoose: (line: number) => void;
  /** A drag begins, goes on at a place of the screen, and ends. */
  onGrip: (grip: Grip) => void;
  onDrag: (at: Seen) => void;
  onDrop: () => void;
}

/** Circles that come nearer than this hide each other. */
const APART_PX = 9;
const TANGENT_PX = 46;
const TOOL_PX = 44;
const TOOL_SIDES = 12;
const LINES = new Set([1, 100, 101, 102]);

/** What lies over the path and keeps its size: ends, tangents, switch points, start and end, tool and trace. */
export function PathOverlay(props: PathOverlayProps) {
  const { eye, frame, summary, chosen, line, movable, tangents, tool, trace, onChoose, onGrip, onDrag, onDrop } = props;
  const t = useText();
  const [held, setHeld] = useState<string | null>(null);
  const at = (place: readonly number[] | null) => (place === null ? null : seenAt(eye, frame, place as Vector));
  const grip = (name: string, grip: Grip) => ({
    'data-held': held === name || undefined,
    onPointerDown: (event: PointerEvent<SVGElement>) => {
      if (event.button !== 0) return;
      event.currentTarget.setPointerCapture(event.pointerId);
      setHeld(name);
      // The keyboard comes here: Del means this element, and the text shows its line as chosen elsewhere.
      event.currentTarget.closest('section')?.focus();
      onChoose(grip.line);
      onGrip(grip);
    },
    onPointerMove: (event: PointerEvent<SVGElement>) => {
      const box = event.currentTarget.ownerSVGElement?.getBoundingClientRect();
      if (held === name && box) onDrag({ x: event.clientX - box.left, y: event.clientY - box.top });
    },
    onPointerUp: () => {
      if (held === name) onDrop();
      setHeld(null);
    },
    onPointerCancel: () => {
      if (held === name) onDrop();
      setHeld(null);
    },
  });
  const shown =
    held === null
      ? spread(
          summary.ends.map(({ place }) => at(place)),
          eye,
        )
      : null;
  const ends = summary.ends.flatMap((mark, index) => {
    const place = at(mark.place);
    if (place === null || (shown !== null && !shown.has(index))) return [];
    const name = `end ${String(index)}`;
    const free = movable(mark.line);
    return [
      <circle
        key={name}
        className={free ? styles.movable : styles.end}
        cx={place.x}
        cy={place.y}
        r={3.5}
        data-line={mark.line}
        {...(free ? grip(name, { kind: 'end', line: mark.line, from: mark.place as unknown as Vector }) : {})}
      />,
    ];
  });
  const first = chosen[0];
  const last = chosen.at(-1);
  const round = chosen.length === 1 && first !== undefined && !LINES.has(first.kind) ? first : null;
  return (
    <svg className={styles.overlay} width={eye.width} height={eye.height} data-testid="path-overlay">
      <Trace places={trace} at={at} />
      {ends}
      {round !== null &&
        (['start', 'end'] as const).map((which) => {
          const from = round[which] as unknown as Vector;
          const length = TANGENT_PX * pixelSize(eye, frame, from);
          const ahead = (which === 'start' ? round.leave : round.arrive) as unknown as Vector;
          const to = at(plus(from, ahead, which === 'start' ? length : -length));
          const base = at(from);
          if (to === null || base === null) return null;
          const tangent = { kind: 'tangent', line: round.line, from, at: which, end: round.end as unknown as Vector };
          return (
            <g key={which} className={styles.tangent}>
              <line x1={base.x} y1={base.y} x2={to.x} y2={to.y} />
              {tangents(round.line) && (
                <rect
                  className={styles.movable}
                  x={to.x - 3}
                  y={to.y - 3}
                  width={6}
                  height={6}
                  data-tangent={which}
                  {...grip(`tangent ${which}`, tangent as Grip)}
                />
              )}
            </g>
          );
        })}
      {summary.switches.map(({ place, line: own, number }, index) => {
        const mark = at(place);
        if (mark === null) return null;
        return (
          <path
            key={`switch ${String(index)}`}
            className={styles.switch}
            d={`M${String(mark.x)} ${String(mark.y - 5)}l5 5l-5 5l-5 -5z`}
            data-off={number < 0 || undefined}
            onClick={() => onChoose(own)}
          >
            <title>{t('cnc.path.switch', { number: String(number) })}</title>
          </path>
        );
      })}
      <Border place={at(summary.start)} sign="start" text={t('cnc.path.start')} />
      <Border place={at(summary.end)} sign="end" text={t('cnc.path.end')} />
      {first !== undefined && last !== undefined && (
        <>
          <Dot place={at(first.start)} className={styles.chosenStart} />
          <Dot
            place={at(last.end)}
            className={styles.chosenEnd}
            {...(line !== null && movable(line)
              ? grip('chosen', { kind: 'end', line, from: last.end as unknown as Vector })
              : {})}
          />
        </>
      )}
      {tool !== null && <Tool eye={eye} frame={frame} place={tool} />}
    </svg>
  );
}

/** Numbers of the marks that leave each other room. */
function spread(places: readonly (Seen | null)[], { width, height }: Eye): ReadonlySet<number> {
  const cells = new Set<string>();
  const kept = new Set<number>();
  places.forEach((place, index) => {
    if (place === null || place.x < 0 || place.y < 0 || place.x > width || place.y > height) return;
    const cell = `${String(Math.round(place.x / APART_PX))} ${String(Math.round(place.y / APART_PX))}`;
    if (cells.has(cell)) return;
    cells.add(cell);
    kept.add(index);
  });
  return kept;
}

function Dot({ place, ...rest }: { place: Seen | null; className: string | undefined }) {
  return place === null ? null : <circle cx={place.x} cy={place.y} r={5} {...rest} />;
}

/** Where the path begins and where it ends. */
function Border({ place, sign, text }: { place: Seen | null; sign: 'start' | 'end'; text: string }) {
  if (place === null) return null;
  const { x, y } = place;
  return (
    <g className={styles.border} data-sign={sign}>
      <title>{text}</title>
      <path
        d={
          sign === 'start'
            ? `M${String(x - 6)} ${String(y + 15)}v-10l10 5z`
            : `M${String(x - 5)} ${String(y + 6)}h10v10h-10z`
        }
      />
    </g>
  );
}

function Trace({ places, at }: { places: readonly Vector[]; at: (place: Vector) => Seen | null }) {
  if (places.length < 2) return null;
  const points = places.flatMap((place) => {
    const seen = at(place);
    return seen === null ? [] : [`${seen.x.toFixed(1)},${seen.y.toFixed(1)}`];
  });
  return <polyline className={styles.trace} points={points.join(' ')} data-testid="path-trace" />;
}

/** A cone that stands on its tip, along Z of the program. */
function Tool({ eye, frame, place }: { eye: Eye; frame: Frame; place: Vector }) {
  const tip = seenAt(eye, frame, place);
  if (tip === null) return null;
  const unit = pixelSize(eye, frame, place);
  const rim = Array.from({ length: TOOL_SIDES }, (_, n) => {
    const angle = (2 * Math.PI * n) / TOOL_SIDES;
    const out = plus(place, [Math.cos(angle), Math.sin(angle), 0], 9 * unit);
    return seenAt(eye, frame, plus(out, [0, 0, 1], TOOL_PX * unit));
  });
  if (rim.some((one) => one === null)) return null;
  const corners = rim as Seen[];
  const text = ({ x, y }: Seen) => `${x.toFixed(1)},${y.toFixed(1)}`;
  return (
    <g className={styles.tool} data-testid="path-tool">
      {corners.map((corner, n) => (
        <polygon key={n} points={[tip, corner, corners[(n + 1) % TOOL_SIDES]!].map(text).join(' ')} />
      ))}
      <polygon points={corners.map(text).join(' ')} />
      <circle cx={tip.x} cy={tip.y} r={3} />
    </g>
  );
}
