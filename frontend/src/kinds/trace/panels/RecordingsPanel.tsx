import { useQueryClient } from '@tanstack/react-query';
import { Layers, Pencil, Settings2, Trash2 } from 'lucide-react';
import { useState } from 'react';
import { durationText } from '@/iec/duration';
import { useText } from '@/i18n';
import { Button, IconButton } from '@/ui/Button';
import { Failed, Loading } from '@/ui/Empty';
import { Field, TextInput } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { confirm, openDialog } from '@/ui/dialogs';
import { guard } from '@/ui/notices';
import { atLeast } from '@/workbench/rights';
import { useCommandContext } from '@/workbench/useCommandContext';
import type { TraceData } from '../configuration';
import { act, sourcePath, type RecordingInfo } from '../data/source';
import { traceKeys, useRecordings } from '../data/useRuns';
import { FIRST_VIEW, type TraceView } from '../traceView';
import { formatBytes } from '../numbers';
import styles from '../Trace.module.css';
import panel from './Panels.module.css';

interface RecordingsPanelProps {
  projectId: string;
  trace: string;
  view: TraceView;
  onView: (change: (view: TraceView) => TraceView) => void;
  /** Takes the configuration of the recording that is shown into the project; null: it cannot be changed. */
  onConfiguration: ((data: TraceData) => void) | null;
  data: TraceData;
}

/** The stored recordings: shown, drawn over what is shown, renamed, deleted. */
export function RecordingsPanel({ projectId, trace, view, onView, onConfiguration, data }: RecordingsPanelProps) {
  const t = useText();
  const queries = useQueryClient();
  const { data: found, error } = useRecordings(projectId);
  const operator = atLeast(useCommandContext().role, 'operator') ? null : t('reason.operator');
  if (error && !found) return <Failed error={error} />;
  if (!found) return <Loading />;
  const own = (one: RecordingInfo) => (one.trace.toLowerCase() === trace.toLowerCase() ? 0 : 1);
  const list = [...found.recordings].sort(
    (one, other) => own(one) - own(other) || other.started_at.localeCompare(one.started_at),
  );
  if (list.length === 0) return <p className={styles.note}>{t('trace.noRecordings')}</p>;
  const look = () => queries.invalidateQueries({ queryKey: traceKeys.recordings(projectId) });
  const show = (id: string) =>
    onView((before) => ({ ...before, shown: id, views: FIRST_VIEW.views, cursors: [], nodes: [], computed: [] }));
  const toggle = (id: string) =>
    onView((before) => ({
      ...before,
      overlays: before.overlays.some((one) => one.id === id)
        ? before.overlays.filter((one) => one.id !== id)
        : [...before.overlays, { id, shift: 0 }],
    }));
  const remove = async ({ id, title }: RecordingInfo) => {
    const sure = await confirm({
      title: t('trace.deleteRecording', { title }),
      text: t('trace.deleteRecordingText'),
      action: t('action.delete'),
      danger: true,
    });
    if (!sure) return;
    await guard(async () => {
      await act('delete', sourcePath({ kind: 'stored', id }));
      onView((before) => ({
        ...before,
        shown: before.shown === id ? null : before.shown,
        overlays: before.overlays.filter((one) => one.id !== id),
      }));
      await look();
    });
  };
  const rename = (recording: RecordingInfo) =>
    void openDialog((close) => <RenameDialog recording={recording} done={() => void look()} close={close} />);
  return (
    <table className={styles.table} aria-label={t('trace.panel.recordings')}>
      <thead>
        <tr>
          <th>{t('trace.title')}</th>
          <th data-text>{t('kind.trace')}</th>
          <th data-text>{t('trace.started')}</th>
          <th>{t('trace.length')}</th>
          <th>{t('trace.samples')}</th>
          <th title={found.keep_days === null ? undefined : t('trace.keptFor', { count: found.keep_days })}>
            {t('trace.size', { used: formatBytes(found.used_bytes), quota: formatBytes(found.quota_bytes) })}
          </th>
          <th />
        </tr>
      </thead>
      <tbody>
        {list.map((one) => (
          <tr key={one.id} aria-selected={one.id === view.shown}>
            <th scope="row">
              <Button variant="quiet" onClick={() => show(one.id)}>
                {one.title}
              </Button>
              {one.state !== 'complete' && (
                <span className={styles.muted}>{` ${t(`trace.recordingState.${one.state}`)}`}</span>
              )}
              <span className={panel.limits} title={limitsOf(one, t)}>
                {limitsOf(one, t)}
              </span>
            </th>
            <td data-text>{one.trace}</td>
            <td data-text>{new Date(one.started_at).toLocaleString()}</td>
            <td>{lengthOf(one)}</td>
            <td>{one.records.reduce((sum, { samples }) => Math.max(sum, samples), 0).toLocaleString()}</td>
            <td>{formatBytes(one.bytes)}</td>
            <td>
              <IconButton
                icon={Layers}
                small
                label={t('trace.overlayOf', { title: one.title })}
                pressed={view.overlays.some(({ id }) => id === one.id)}
                disabledReason={one.id === view.shown ? t('trace.isShown') : null}
                onClick={() => toggle(one.id)}
              />
              <IconButton
                icon={Settings2}
                small
                label={t('trace.takeConfiguration', { title: one.title })}
                disabledReason={
                  one.id !== view.shown ? t('trace.showFirst') : onConfiguration === null ? t('reason.engineer') : null
                }
                onClick={() => onConfiguration?.(data)}
              />
              <IconButton
                icon={Pencil}
                small
                label={t('trace.renameOf', { title: one.title })}
                disabledReason={operator}
                onClick={() => rename(one)}
              />
              <IconButton
                icon={Trash2}
                small
                label={t('trace.deleteOf', { title: one.title })}
                disabledReason={operator ?? (one.state === 'recording' ? t('trace.reason.recording') : null)}
                onClick={() => void remove(one)}
              />
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** What a long-term recording keeps, and what that has cost. */
function limitsOf(recording: RecordingInfo, t: ReturnType<typeof useText>): string {
  const { keep_seconds: seconds, keep_bytes: bytes, dropped } = recording;
  return [
    ...(seconds === null ? [] : [t('trace.keepsAge', { time: durationText(seconds * 1e9) })]),
    ...(bytes === null ? [] : [t('trace.keepsSize', { size: formatBytes(bytes) })]),
    ...(dropped === 0 ? [] : [t('trace.dropped', { samples: dropped.toLocaleString() })]),
  ].join(' · ');
}

function lengthOf(recording: RecordingInfo): string {
  const spans = recording.records
    .filter(({ samples }) => samples > 0)
    .map(({ first_ns, last_ns }) => Number(BigInt(last_ns ?? 0) - BigInt(first_ns ?? 0)));
  return spans.length === 0 ? '–' : durationText(Math.round(Math.max(...spans) / 1e6) * 1e6);
}

function RenameDialog({
  recording,
  done,
  close,
}: {
  recording: RecordingInfo;
  done: () => void;
  close: (answer?: true) => void;
}) {
  const t = useText();
  const [title, setTitle] = useState(recording.title);
  const [comment, setComment] = useState(recording.comment);
  const save = () =>
    guard(async () => {
      await act('patch', sourcePath({ kind: 'stored', id: recording.id }), { title, comment });
      done();
      close(true);
    });
  return (
    <FormDialog
      title={t('trace.renameRecording')}
      action={t('action.save')}
      disabledReason={title.trim() === '' ? t('trace.fault.name') : null}
      onClose={() => close()}
      onSubmit={() => void save()}
    >
      <Field row label={t('trace.title')}>
        {(attributes) => <TextInput {...attributes} value={title} onValue={setTitle} />}
      </Field>
      <Field row label={t('trace.comment')}>
        {(attributes) => <TextInput {...attributes} value={comment} onValue={setComment} />}
      </Field>
    </FormDialog>
  );
}
