import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { api } from '@/api/client';
import { projectsQuery, runtimesQuery } from '@/api/queries';
import { useText } from '@/i18n';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Field, Select } from '@/ui/Field';
import { FormDialog } from '@/ui/FormDialog';
import { guard } from '@/ui/notices';
import { RadioCards } from '@/ui/RadioCards';
import { secondText } from '@/workbench/clock';
import { filesToSend, type NamedFile } from '@/workbench/exchange/dropped';
import { FilesStep } from '@/workbench/exchange/FilesStep';
import type { Comparison, Ignoring } from './comparison';
import styles from './compare.module.css';
import { ComparisonView } from './ComparisonView';
import { useDifferences, useForgotten } from './useComparison';
import { useMerge } from './useMerge';

interface CompareDialogProps {
  projectId: string;
  projectName: string;
  runtimeId: string | null;
  /** A comparison that has been made already: nothing is chosen any more. */
  found?: Comparison;
  close: () => void;
}

type Source = 'project' | 'files' | 'runtime';

/** Compares the open project with another one, with files, or with what a runtime runs. */
export function CompareDialog(props: CompareDialogProps) {
  const { projectId, projectName, close } = props;
  const [opened, setOpened] = useState<Comparison | null>(props.found ?? null);
  useForgotten(projectId, opened?.id);
  return opened ? (
    <ComparedDialog projectId={projectId} projectName={projectName} opened={opened} close={close} />
  ) : (
    <SourceDialog {...props} open={setOpened} />
  );
}

/** Chooses what to compare with. */
function SourceDialog({ projectId, runtimeId, open, close }: CompareDialogProps & { open: (one: Comparison) => void }) {
  const t = useText();
  const [source, setSource] = useState<Source>('project');
  const [busy, setBusy] = useState(false);
  const [files, setFiles] = useState<readonly NamedFile[]>([]);
  const [other, setOther] = useState<string | null>(null);
  const [chosenRuntime, setRuntime] = useState(runtimeId);
  const projects = (useQuery(projectsQuery).data ?? []).filter((one) => one.id !== projectId);
  const runtimes = useQuery(runtimesQuery).data ?? [];
  const runtime = chosenRuntime ?? runtimes[0]?.id ?? null;
  const missing = { project: !other, files: files.length === 0, runtime: !runtime }[source];
  const path = { project_id: projectId };
  const ask = async () => {
    if (source === 'files')
      return api.post('/api/v1/projects/{project_id}/comparisons/files', {
        params: { path },
        body: { files: filesToSend(files) },
      });
    const old =
      source === 'project'
        ? ({ kind: 'project', project_id: other! } as const)
        : ({ kind: 'runtime', runtime_id: runtime! } as const);
    return api.post('/api/v1/projects/{project_id}/comparisons', { params: { path }, body: { old } });
  };
  const submit = async () => {
    setBusy(true);
    const found = await guard(ask);
    setBusy(false);
    if (found) open(found);
  };
  return (
    <FormDialog
      title={t('command.compare')}
      width={620}
      action={t('compare.compare')}
      disabledReason={busy ? t('reason.busy') : missing ? t(`compare.missing.${source}`) : null}
      onClose={close}
      onSubmit={() => void submit()}
    >
      <RadioCards
        label={t('compare.with')}
        value={source}
        onValue={setSource}
        cards={(['project', 'files', 'runtime'] as const).map((value) => ({
          value,
          name: t(`compare.source.${value}`),
          effect: t(`compare.source.${value}Text`),
        }))}
      />
      {source === 'project' && (
        <Field label={t('compare.source.project')}>
          {(attributes) => (
            <Select
              {...attributes}
              value={other}
              onValue={setOther}
              placeholder={t('compare.missing.project')}
              choices={projects.map((one) => ({ value: one.id, text: one.name }))}
            />
          )}
        </Field>
      )}
      {source === 'files' && <FilesStep files={files} change={setFiles} />}
      {source === 'runtime' && (
        <Field label={t('compare.source.runtime')}>
          {(attributes) => (
            <Select
              {...attributes}
              value={runtime}
              onValue={setRuntime}
              placeholder={t('compare.missing.runtime')}
              choices={runtimes.map((one) => ({ value: one.id, text: one.name }))}
            />
          )}
        </Field>
      )}
    </FormDialog>
  );
}

interface ComparedDialogProps {
  projectId: string;
  projectName: string;
  opened: Comparison;
  close: () => void;
}

function ComparedDialog({ projectId, projectName, opened, close }: ComparedDialogProps) {
  const t = useText();
  const [ignoring, setIgnoring] = useState<Ignoring>({ white_space: false, comments: false, pragmas: false });
  const query = useDifferences(projectId, opened, ignoring);
  const comparison = query.data ?? opened;
  const { choices, choose, refused, count, merge } = useMerge(projectId, comparison, query.refetch);
  const title = opened.at ? t('text.andMore', { text: opened.title, more: secondText(opened.at) }) : opened.title;
  return (
    <Dialog
      title={t('compare.title', { name: projectName, other: opened.title })}
      width={1500}
      onClose={close}
      footer={
        <>
          {opened.notes.length > 0 && (
            <span className={styles.notes} title={opened.notes.join('\n')}>
              {t('compare.notes', { count: opened.notes.length })}
            </span>
          )}
          <Button onClick={close}>{t('action.close')}</Button>
          <Button variant="primary" disabledReason={refused} onClick={() => void merge()}>
            {count > 0 ? t('compare.takeSome', { count }) : t('compare.take')}
          </Button>
        </>
      }
    >
      <ComparisonView
        projectId={projectId}
        comparison={comparison}
        titles={[title, t('compare.thisProject', { name: projectName })]}
        ignoring={ignoring}
        ignore={setIgnoring}
        choices={choices}
        choose={choose}
      />
    </Dialog>
  );
}
