import { ChevronDown, ChevronUp, Plus } from 'lucide-react';
import { useRef, useState, type KeyboardEvent, type PointerEvent } from 'react';
import { useText } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import { Button, IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { domainOf, type CamTable } from './camTable';
import styles from './Cam.module.css';
import type { CamEdit, Tool } from './edit';
import { MasterAxis } from './GraphsTab';
import { MARGIN_LEFT, MARGIN_RIGHT, niceStep, type Range, snapped } from './plot';
import {
  addTappet,
  addTrack,
  deleteTappet,
  nextAction,
  nextTrackId,
  setTappet,
  setTrackId,
  tappetOf,
  type TappetPlace,
} from './tappets';
import { TappetSign, type SignSide } from './TappetSign';
import { onRanges } from './tappetBit';
import { RunMarks } from './RunMarks';
import { useSize } from '@/editors/plot/useSize';

const HEIGHT = 56;
const MIDDLE = 30;
const NEAR = 6;
const X_TICK_PX = 90;

/** The tracks of tappets over the master (CAM-50 to CAM-54). */
export function TappetsTab({ edit, tool, onTool }: { edit: CamEdit; tool: Tool; onTool: (tool: Tool) => void }) {
  const t = useText();
  const [first, last] = domainOf(edit.cam);
  const window: Range = { min: first, max: last };
  if (edit.cam.tracks.length === 0)
    return (
      <Empty title={t('cam.noTracks')} text={t('cam.noTracksText')}>
        <AddTrack edit={edit} />
      </Empty>
    );
  return (
    <div className={styles.graphs}>
      <div className={styles.tracks}>
        {edit.cam.tracks.map((track, index) => (
          <Track key={track.id} edit={edit} track={index} window={window} tool={tool} onTool={onTool} />
        ))}
        <div className={styles.addTrack}>
          <AddTrack edit={edit} quiet />
        </div>
      </div>
      <MasterAxis window={window} title={t('cam.master')} />
    </div>
  );
}

function AddTrack({ edit, quiet }: { edit: CamEdit; quiet?: boolean }) {
  const t = useText();
  return (
    <Button
      variant={quiet ? 'quiet' : 'default'}
      icon={Plus}
      disabledReason={edit.locked ? t('cam.locked') : null}
      onClick={() => {
        const added = addTrack(edit.cam);
        edit.change(added.cam, { kind: 'tappet', ...added.place });
      }}
    >
      {t('cam.addTrack')}
    </Button>
  );
}

interface TrackProps {
  edit: CamEdit;
  track: number;
  window: Range;
  tool: Tool;
  onTool: (tool: Tool) => void;
}

function Track({ edit, track, window, tool, onTool }: TrackProps) {
  const t = useText();
  const { cam, locked, selected } = edit;
  const frame = useRef<HTMLDivElement>(null);
  const { width } = useSize(frame);
  const plot = Math.max(1, width - MARGIN_LEFT - MARGIN_RIGHT);
  const px = (x: number) => MARGIN_LEFT + ((x - window.min) / (window.max - window.min)) * plot;
  const step = niceStep(window, plot / X_TICK_PX) / 10;
  const drag = useRef<{ place: TappetPlace; cam: CamTable; from: number; x: number; last: CamTable | null } | null>(
    null,
  );
  const [pointer, setPointer] = useState<number | null>(null);
  const [dragging, setDragging] = useState(false);
  const xAt = (event: { clientX: number }) => {
    const left = event.clientX - frame.current!.getBoundingClientRect().left - MARGIN_LEFT;
    return window.min + (left / plot) * (window.max - window.min);
  };
  const item = cam.tracks[track]!;

  const sideAt = (event: PointerEvent, index: number): SignSide | 'centre' | null => {
    const box = frame.current!.getBoundingClientRect();
    const [dx, dy] = [event.clientX - box.left - px(item.tappets[index]!.x), event.clientY - box.top - MIDDLE];
    if (Math.abs(dy) > 14) return null;
    if (Math.abs(dx) <= NEAR) return 'centre';
    if (dx < 0 && dx >= -20) return 'positive';
    return dx > 0 && dx <= 20 ? 'negative' : null;
  };
  const onPointerDown = (event: PointerEvent) => {
    if (event.button !== 0) return;
    frame.current?.focus();
    if (tool === 'add' && !locked) {
      const added = addTappet(cam, track, snapped(xAt(event), step));
      edit.change(added.cam, { kind: 'tappet', ...added.place });
      onTool('select');
      return;
    }
    // The centre of one tappet lies over the end of another.
    const sides = item.tappets.map((_, index) => sideAt(event, index));
    const at = sides.includes('centre') ? sides.lastIndexOf('centre') : sides.findIndex((side) => side !== null);
    if (at < 0) {
      edit.select(null);
      return;
    }
    const place = { track, index: at };
    const side = sides[at]!;
    edit.select({ kind: 'tappet', ...place });
    if (side !== 'centre') {
      if (!locked) edit.change(setTappet(cam, place, { [side]: nextAction(item.tappets[at]![side]) }).cam);
      return;
    }
    event.currentTarget.setPointerCapture(event.pointerId);
    drag.current = { place, cam, from: xAt(event), x: item.tappets[at]!.x, last: null };
    setDragging(true);
  };
  const onPointerMove = (event: PointerEvent) => {
    setPointer(xAt(event));
    const now = drag.current;
    if (now === null || locked) return;
    const wanted = now.x + xAt(event) - now.from;
    if (now.last === null && Math.abs(px(wanted) - px(now.x)) < 3) return;
    const moved = setTappet(now.cam, now.place, { x: event.altKey ? wanted : snapped(wanted, step) });
    now.last = moved.cam;
    edit.preview(moved.cam, { kind: 'tappet', ...moved.place });
  };
  const finish = (taken: boolean) => {
    const now = drag.current;
    drag.current = null;
    setDragging(false);
    if (now?.last == null) return;
    if (taken) edit.change(now.last);
    else edit.preview(null, { kind: 'tappet', ...now.place });
  };
  const here = selected?.kind === 'tappet' && selected.track === track ? selected : null;
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.target !== event.currentTarget) return;
    const used = () => {
      event.preventDefault();
      event.stopPropagation();
    };
    const arrow = event.key === 'ArrowLeft' ? -1 : event.key === 'ArrowRight' ? 1 : 0;
    const tappet = here && tappetOf(cam, here);
    if (event.key === 'Insert' && !locked) {
      const added = addTappet(cam, track, tappet?.x ?? 0);
      edit.change(added.cam, { kind: 'tappet', ...added.place });
      used();
    } else if (event.key === 'Escape') {
      if (drag.current) finish(false);
      else if (tool === 'add') onTool('select');
      else edit.select(null);
      used();
    } else if (arrow !== 0 && event.ctrlKey && tappet && !locked) {
      const moved = setTappet(cam, here, { x: tappet.x + arrow * step * (event.shiftKey ? 10 : 1) });
      edit.change(moved.cam, { kind: 'tappet', ...moved.place });
      used();
    } else if (arrow !== 0 && item.tappets.length > 0) {
      const index = here === null ? (arrow > 0 ? 0 : item.tappets.length - 1) : here.index + arrow;
      edit.select({ kind: 'tappet', track, index: Math.max(0, Math.min(item.tappets.length - 1, index)) });
      used();
    } else if (event.key === 'Delete' && here && !locked) {
      edit.change(deleteTappet(cam, here), null);
      used();
    } else if ((event.key === '<' || event.key === '>') && tappet && !locked) {
      const side = event.key === '<' ? 'positive' : 'negative';
      edit.change(setTappet(cam, here, { [side]: nextAction(tappet[side]) }).cam);
      used();
    }
  };
  const idStep = (by: 1 | -1) => nextTrackId(cam, track, by);
  return (
    <div className={styles.trackRow}>
      <div
        ref={frame}
        className={styles.track}
        data-tool={tool === 'add' && !locked ? 'add' : undefined}
        role="application"
        aria-roledescription={t('cam.trackRole')}
        aria-label={t('cam.trackLabel', { track: item.id })}
        tabIndex={0}
        onKeyDown={onKeyDown}
        onPointerDown={onPointerDown}
        onPointerMove={onPointerMove}
        onPointerUp={() => finish(true)}
        onPointerCancel={() => finish(false)}
        onPointerLeave={() => setPointer(null)}
      >
        <svg width={width} height={HEIGHT} aria-hidden>
          <text
            className={styles.trackName}
            x={MARGIN_LEFT - 10}
            y={MIDDLE}
            textAnchor="end"
            dominantBaseline="central"
          >
            {t('cam.trackName', { track: item.id })}
          </text>
          <line className={styles.zeroLine} x1={MARGIN_LEFT} x2={MARGIN_LEFT + plot} y1={MIDDLE} y2={MIDDLE} />
          {onRanges(item.tappets, window).map(([from, to]) => (
            <line key={from} className={styles.bitOn} x1={px(from)} x2={px(to)} y1={MIDDLE + 20} y2={MIDDLE + 20} />
          ))}
          {edit.running && <RunMarks {...edit.running} window={window} width={plot} height={HEIGHT} />}
          {item.tappets.map((tappet, index) => (
            <TappetSign
              key={index}
              x={px(tappet.x)}
              y={MIDDLE}
              positive={tappet.positive}
              negative={tappet.negative}
              selected={here?.index === index}
            />
          ))}
        </svg>
        {pointer !== null && pointer >= window.min && pointer <= window.max && (
          <div className={styles.readout} style={{ left: Math.min(px(pointer) + 14, Math.max(0, width - 90)), top: 2 }}>
            {`X ${numberText(snapped(here && dragging ? (tappetOf(cam, here)?.x ?? pointer) : pointer, step / 10))}`}
          </div>
        )}
      </div>
      <div className={styles.trackId}>
        {([1, -1] as const).map((by) => (
          <IconButton
            key={by}
            small
            icon={by === 1 ? ChevronUp : ChevronDown}
            label={t(by === 1 ? 'cam.trackUp' : 'cam.trackDown')}
            disabledReason={locked ? t('cam.locked') : idStep(by) === null ? t('cam.noTrackId') : null}
            onClick={() => {
              const id = idStep(by);
              if (id !== null) edit.change(setTrackId(cam, track, id));
            }}
          />
        ))}
      </div>
    </div>
  );
}
