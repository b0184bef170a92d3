import { Download, FileUp, History, Play } from 'lucide-react';
import { useRef, useState } from 'react';
import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { ofKind } from '@/api/objects';
import type { DataOfKind, RuntimeException, Schemas } from '@/api/types';
import { FormPage, Section } from '@/editors/form/FormPage';
import { useDraft, type Draft } from '@/editors/form/useDraft';
import { useText } from '@/i18n';
import { lookInto } from '@/online/past/recordings';
import type { EditorProps } from '@/project/editorProps';
import { objectIcon } from '@/project/kinds';
import { Button } from '@/ui/Button';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Facts } from '@/ui/Facts';
import { Checkbox, Field, Select, TextArea } from '@/ui/Field';
import { guard } from '@/ui/notices';
import { secondText } from '@/workbench/clock';
import { saveBlob } from '@/workbench/downloadFile';
import { exceptionPlace, exceptionTitle, jumpToFrame } from '@/workbench/online/exception';
import { spanText } from '@/workbench/online/pastText';
import styles from './Recording.module.css';

type RecordingData = DataOfKind['flight_recording'];
type Report = Schemas['ReplayReport'];

/** What a recording holds, the ways into it, and what comes of running it again. */
export default function RecordingEditor({ panelId, projectId, objectId }: EditorProps) {
  const draft = useDraft(panelId, projectId, objectId, ofKind('flight_recording'), () => true);
  return (
    <FormPage draft={draft}>
      {(data) =>
        data.recording === '' ? (
          <Nothing draft={draft} />
        ) : (
          <Held projectId={projectId} objectId={objectId} draft={draft} data={data} />
        )
      }
    </FormPage>
  );
}

function Nothing({ draft }: { draft: Draft<RecordingData> }) {
  const t = useText();
  const input = useRef<HTMLInputElement>(null);
  const take = async (file: File | undefined) => {
    if (file && draft.data) draft.change({ ...draft.data, recording: await file.text() });
  };
  return (
    <Empty icon={objectIcon('flight_recording')} title={t('recording.empty')} text={t('recording.emptyText')}>
      <Button icon={FileUp} disabledReason={draft.readOnly} onClick={() => input.current?.click()}>
        {t('recording.choose')}
      </Button>
      <input
        ref={input}
        type="file"
        hidden
        accept=".flight"
        aria-label={t('recording.choose')}
        onChange={(event) => void take(event.target.files?.[0])}
      />
    </Empty>
  );
}

interface HeldProps {
  projectId: string;
  objectId: string;
  draft: Draft<RecordingData>;
  data: RecordingData;
}

function Held({ projectId, objectId, draft, data }: HeldProps) {
  const t = useText();
  const at = { params: { path: { project_id: projectId, object_id: objectId } } };
  const facts = useQuery({
    queryKey: ['recording', projectId, objectId, data.recording.slice(0, 120)],
    queryFn: () => api.get('/api/v1/projects/{project_id}/recordings/{object_id}', at),
    staleTime: Infinity,
    retry: false,
  });
  if (facts.error) return <Failed error={facts.error} retry={() => void facts.refetch()} />;
  if (!facts.data) return <Loading />;
  const held = facts.data;
  const length = Date.parse(held.last_timestamp) - Date.parse(held.first_timestamp);
  const name = draft.object?.name ?? '';
  return (
    <>
      <Section title={t('recording.title')}>
        <Facts>
          <dt>{t('recording.application')}</dt>
          <dd>{held.application}</dd>
          <dt>{t('recording.saved')}</dt>
          <dd className="digits">{secondText(held.saved_at)}</dd>
          <dt>{t('recording.cycles')}</dt>
          <dd className="digits">
            {t('recording.cyclesText', { cycles: held.cycles, first: held.first_cycle, last: held.last_cycle })}
          </dd>
          <dt>{t('recording.length')}</dt>
          <dd className="digits">{spanText(length)}</dd>
          <dt>{t('recording.writes')}</dt>
          <dd className="digits">{held.writes}</dd>
          <dt>{t('recording.end')}</dt>
          <dd>{held.exception ? <Fault exception={held.exception} /> : t('recording.noFault')}</dd>
        </Facts>
        <div className={styles.acts}>
          <Button variant="primary" icon={History} onClick={() => void guard(() => lookInto(projectId, objectId))}>
            {t('recording.look')}
          </Button>
          <Button
            icon={Download}
            onClick={() => saveBlob(new Blob([data.recording], { type: 'text/plain' }), `${name}.flight`)}
          >
            {t('recording.download')}
          </Button>
        </div>
      </Section>
      <Replay projectId={projectId} objectId={objectId} />
      <Section title={t('recording.test')}>
        <Checkbox
          checked={data.tested}
          disabled={draft.readOnly !== null}
          onChecked={(tested) => draft.change({ ...data, tested })}
        >
          {t('recording.tested')}
        </Checkbox>
        <Field label={t('recording.expects')}>
          {(attributes) => (
            <Select
              {...attributes}
              className={styles.expects}
              value={data.expects}
              disabled={draft.readOnly !== null || !data.tested}
              choices={[
                { value: 'no_fault', text: t('recording.expects.no_fault') },
                {
                  value: 'same_fault',
                  text: t('recording.expects.same_fault'),
                  disabled: held.exception === null,
                },
              ]}
              onValue={(expects) => draft.change({ ...data, expects })}
            />
          )}
        </Field>
        <Field label={t('recording.comment')}>
          {(attributes) => (
            <TextArea
              {...attributes}
              rows={4}
              value={data.comment}
              readOnly={draft.readOnly !== null}
              onValue={(comment) => draft.change({ ...data, comment })}
            />
          )}
        </Field>
      </Section>
    </>
  );
}

function Replay({ projectId, objectId }: { projectId: string; objectId: string }) {
  const t = useText();
  const [report, setReport] = useState<Report | null>(null);
  const [running, setRunning] = useState(false);
  const run = (today: boolean) =>
    guard(async () => {
      setRunning(true);
      try {
        const params = { path: { project_id: projectId, object_id: objectId } };
        const path = '/api/v1/projects/{project_id}/recordings/{object_id}/replay';
        setReport(await api.post(path, { params, body: { today } }));
      } finally {
        setRunning(false);
      }
    });
  const reason = running ? t('state.loading') : null;
  return (
    <Section title={t('recording.replay')}>
      <p className={styles.text}>{t('recording.replayText')}</p>
      <div className={styles.acts}>
        <Button icon={Play} disabledReason={reason} onClick={() => void run(false)}>
          {t('recording.then')}
        </Button>
        <Button icon={Play} disabledReason={reason} onClick={() => void run(true)}>
          {t('recording.today')}
        </Button>
      </div>
      {report && <Outcome report={report} />}
    </Section>
  );
}

function Outcome({ report }: { report: Report }) {
  const t = useText();
  return (
    <div className={styles.outcome} data-ok={report.ok} role="status">
      {report.problem !== null && <p>{report.problem}</p>}
      {report.problem === null && report.today && <p>{t(report.fault ? 'recording.still' : 'recording.mended')}</p>}
      {report.problem === null && !report.today && (
        <p>
          {report.first_difference === null
            ? t('recording.same', { cycle: report.last_cycle })
            : t('recording.differs', { cycle: report.first_difference })}
        </p>
      )}
      {report.problem === null && report.today && report.first_difference !== null && (
        <p>{t('recording.differsToday', { cycle: report.first_difference })}</p>
      )}
      {report.fault && !report.today && report.same_fault && <p>{t('recording.sameFault')}</p>}
      {report.fault && <Fault exception={report.fault} />}
      {report.variables.length > 0 && (
        <table className={styles.values}>
          <thead>
            <tr>
              <th>{t('online.column.expression')}</th>
              <th>{t('recording.wasRecorded')}</th>
              <th>{t('recording.replayed')}</th>
            </tr>
          </thead>
          <tbody>
            {report.variables.map(({ name, recorded, replayed }) => (
              <tr key={name}>
                <td>{name}</td>
                <td>{recorded}</td>
                <td>{replayed}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {report.notes.map((note) => (
        <p key={note}>{note}</p>
      ))}
    </div>
  );
}

function Fault({ exception }: { exception: RuntimeException }) {
  const text = `${exceptionTitle(exception)} · ${exceptionPlace(exception)}`;
  if (exception.object_id === null) return <span>{text}</span>;
  return (
    <button type="button" className={styles.link} onClick={() => jumpToFrame(exception)}>
      {text}
    </button>
  );
}
