import { useMemo, useState } from 'react';
import { api, isCancelled } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ImportEntry, ObjectSummary, Schemas } from '@/api/types';
import { useText } from '@/i18n';
import { displayPath } from '@/project/objectName';
import { notifyError } from '@/ui/notices';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { FormDialog } from '@/ui/FormDialog';
import { Loading } from '@/ui/Empty';
import { Field, Select, TextInput } from '@/ui/Field';
import { filesToSend, type NamedFile } from './dropped';
import styles from './Exchange.module.css';
import { FilesStep } from './FilesStep';
import { compareImport } from './comparison';
import {
  decisionsOf,
  existingRows,
  NOTHING_CHOSEN,
  undecidedEntries,
  withChoice,
  wrongNames,
  type ExistingRow,
} from './existing';
import { ExistingTable } from './ExistingTable';
import { placesOf, placeText, proposedPlace } from './model';
import { ObjectChoice } from './ObjectChoice';
import { nodeForest } from './choice';
import { ReportView } from './ReportView';

/** The project that an import may go into. */
export interface ImportTarget {
  projectId: string;
  projectName: string;
  objects: readonly ObjectSummary[];
  selected: ObjectSummary | undefined;
  applicationId: string | null;
}

interface ImportDialogProps {
  /** Null: there is none open, a new project is made. */
  target: ImportTarget | null;
  files?: readonly NamedFile[];
  /** Opens an object of the open project. */
  openObject?: (entry: ImportEntry) => void;
  openProject: (projectId: string) => void;
  close: () => void;
}

type Into = 'here' | 'new';
type Preview = Schemas['ImportPreview'];
type Step = { at: 'files' } | { at: 'choose'; preview: Preview } | { at: 'report'; result: Schemas['ImportResult'] };

/** Files of other systems, ST texts and our own archives: choose them, choose of what they hold, read the report. */
export function ImportDialog({ target, files: given = [], openObject, openProject, close }: ImportDialogProps) {
  const t = useText();
  const [files, setFiles] = useState(given);
  const [into, setInto] = useState<Into>(target ? 'here' : 'new');
  const [name, setName] = useState('');
  const places = useMemo(() => placesOf(target?.objects ?? []), [target]);
  const [place, setPlace] = useState(() =>
    target ? proposedPlace(places, target.objects, target.selected, target.applicationId) : '',
  );
  const [step, setStep] = useState<Step>({ at: 'files' });
  const [chosen, setChosen] = useState<ReadonlySet<string>>(new Set());
  const [choices, setChoices] = useState(NOTHING_CHOSEN);
  const [abort, setAbort] = useState<AbortController | null>(null);
  const forest = useMemo(() => nodeForest(step.at === 'choose' ? step.preview.nodes : []), [step]);
  const here = into === 'here' ? target : null;
  const existing = useMemo(() => existingRows(forest, chosen, choices), [forest, chosen, choices]);
  const wrong = useMemo(() => {
    const byId = new Map(target?.objects.map((object) => [object.id, object]));
    return wrongNames(existing, ({ existing: { object_id } }, name) => {
      const place = byId.get(object_id)?.parent_id;
      return [...byId.values()].some((one) => one.parent_id === place && one.name.toLowerCase() === name);
    });
  }, [existing, target]);

  const run = async (act: (signal: AbortSignal) => Promise<void>) => {
    const controller = new AbortController();
    setAbort(controller);
    try {
      await act(controller.signal);
    } catch (error) {
      if (!isCancelled(error)) notifyError(error);
    } finally {
      setAbort(null);
    }
  };
  const preview = () =>
    run(async (signal) => {
      const target = here && { project_id: here.projectId, place };
      const body = { files: filesToSend(files), ...target };
      const found = await api.post('/api/v1/projects/preview-files', { body, signal });
      setChosen(new Set(found.nodes.map((node) => node.key)));
      setChoices(NOTHING_CHOSEN);
      setStep({ at: 'choose', preview: found });
    });
  const importNow = (found: Preview) =>
    run(async (signal) => {
      const all = chosen.size === found.nodes.length;
      const order = { files: filesToSend(files), chosen: all ? null : JSON.stringify([...chosen]) };
      const result = await (here
        ? api.post('/api/v1/projects/{project_id}/import-files', {
            params: { path: { project_id: here.projectId } },
            body: { ...order, place, existing: JSON.stringify(decisionsOf(existing, choices)) },
            signal,
          })
        : api.post('/api/v1/projects/import-files', { body: { ...order, name: name.trim() || null }, signal }));
      await queryClient.invalidateQueries({ queryKey: here ? keys.objects(here.projectId) : keys.projects });
      setStep({ at: 'report', result });
    });
  const compare = ({ node }: ExistingRow) =>
    run(async (signal) => {
      const comparison = await api.post('/api/v1/projects/{project_id}/compare-import', {
        params: { path: { project_id: here!.projectId } },
        body: { files: filesToSend(files), place, key: node.key },
        signal,
      });
      const texts = await compareImport({ name: node.name, comparison, texts: choices.one.get(node.key)?.texts });
      if (texts) setChoices((before) => withChoice(before, node.key, { act: 'merge', texts }));
    });
  const cancel = () => (abort ? abort.abort() : close());
  const title = t('command.import');

  if (step.at === 'report') {
    const { result } = step;
    return (
      <Dialog
        title={t('exchange.reportOf', { name: result.project.name })}
        width={940}
        onClose={close}
        footer={
          <>
            {!here && (
              <Button
                onClick={() => {
                  close();
                  openProject(result.project.id);
                }}
              >
                {t('exchange.openProject')}
              </Button>
            )}
            <Button variant="primary" data-autofocus onClick={close}>
              {t('action.close')}
            </Button>
          </>
        }
      >
        <ReportView
          entries={result.report.entries}
          open={
            here && openObject
              ? (entry) => {
                  if (!entry.object_id) return;
                  close();
                  openObject(entry);
                }
              : undefined
          }
        />
      </Dialog>
    );
  }
  if (step.at === 'choose') {
    const { preview: found } = step;
    const noteworthy = undecidedEntries(found.report.entries, found.nodes);
    return (
      <FormDialog
        title={title}
        width={940}
        action={t('exchange.import')}
        disabledReason={
          abort
            ? t('reason.busy')
            : wrong.size
              ? t('exchange.wrongNames')
              : chosen.size
                ? null
                : t('exchange.nothingChosen')
        }
        onClose={cancel}
        onSubmit={() => void importNow(found)}
        aside={
          <>
            <span className={styles.count}>
              {t('exchange.chosen', { chosen: chosen.size, count: found.nodes.length })}
            </span>
            <Button disabledReason={abort ? t('reason.busy') : null} onClick={() => setStep({ at: 'files' })}>
              {t('exchange.back')}
            </Button>
          </>
        }
      >
        <ObjectChoice
          label={t('exchange.contents')}
          forest={forest}
          chosen={chosen}
          change={setChosen}
          tooltipOf={placeText}
          short={existing.length > 0}
        />
        {existing.length > 0 && (
          <ExistingTable
            rows={existing}
            choices={choices}
            wrong={wrong}
            change={setChoices}
            compare={(row) => void compare(row)}
          />
        )}
        {noteworthy.length > 0 && (
          <section className={styles.noteworthy} aria-label={t('exchange.noteworthy')}>
            <ReportView entries={noteworthy} />
          </section>
        )}
      </FormDialog>
    );
  }
  return (
    <FormDialog
      title={title}
      width={640}
      action={t('exchange.next')}
      disabledReason={abort ? t('reason.busy') : files.length ? null : t('exchange.noFiles')}
      aside={abort && <Loading />}
      onClose={cancel}
      onSubmit={() => void preview()}
    >
      <FilesStep files={files} change={setFiles} />
      {target && (
        <Field label={t('exchange.into')}>
          {(attributes) => (
            <Select
              {...attributes}
              value={into}
              choices={[
                { value: 'here', text: t('exchange.thisProject', { name: target.projectName }) },
                { value: 'new', text: t('exchange.newProject') },
              ]}
              onValue={setInto}
            />
          )}
        </Field>
      )}
      {here ? (
        <Field label={t('exchange.placeInTree')} hint={t('exchange.placeHint')}>
          {(attributes) => (
            <Select
              {...attributes}
              value={place}
              choices={places.map((one) => ({
                value: one.id,
                text: one.names.length ? displayPath(one.names.join('/')) : t('panel.pous'),
              }))}
              onValue={setPlace}
            />
          )}
        </Field>
      ) : (
        <Field label={t('exchange.projectName')} hint={t('exchange.projectNameHint')}>
          {(attributes) => <TextInput {...attributes} value={name} onValue={setName} />}
        </Field>
      )}
    </FormDialog>
  );
}
