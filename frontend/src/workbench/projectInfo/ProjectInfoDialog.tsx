import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { api } from '@/api/client';
import { keys, projectQuery, queryClient, useObjects } from '@/api/queries';
import type { ProjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { secondText } from '../clock';
import { atLeast } from '../rights';
import { commandContext } from '../context';
import { guard } from '@/ui/notices';
import { useProject } from '@/project/openProject';
import { Dialog } from '@/ui/Dialog';
import { FormDialog } from '@/ui/FormDialog';
import { Failed, Loading } from '@/ui/Empty';
import { Facts } from '@/ui/Facts';
import { ProjectFields } from './ProjectFields';

/** Name, description and size of the project. */
export function ProjectInfoDialog({ projectId, close }: { projectId: string; close: () => void }) {
  const t = useText();
  const { data, error } = useQuery(projectQuery(projectId));
  if (error || !data) {
    return (
      <Dialog title={t('command.projectInformation')} onClose={close}>
        {error ? <Failed error={error} /> : <Loading />}
      </Dialog>
    );
  }
  return <InfoForm project={data} close={close} />;
}

function InfoForm({ project, close }: { project: ProjectSummary; close: () => void }) {
  const t = useText();
  const { data: objects } = useObjects(project.id);
  const [name, setName] = useState(project.name);
  const [description, setDescription] = useState(project.description);
  const mayChange = atLeast(commandContext().role, 'engineer');
  const fault = name.trim() === '' ? t('name.empty') : null;

  const save = async () => {
    const saved = await guard(() =>
      api.patch('/api/v1/projects/{project_id}', {
        params: { path: { project_id: project.id } },
        body: { name: name.trim(), description },
      }),
    );
    if (!saved) return;
    queryClient.setQueryData(keys.project(project.id), saved);
    void queryClient.invalidateQueries({ queryKey: keys.projects });
    useProject.setState({ projectName: saved.name });
    close();
  };

  return (
    <FormDialog
      title={t('command.projectInformation')}
      onClose={close}
      onSubmit={() => void save()}
      action={t('action.save')}
      disabledReason={fault ?? (mayChange ? null : t('reason.engineer'))}
    >
      <ProjectFields
        name={name}
        description={description}
        readOnly={!mayChange}
        onName={setName}
        onDescription={setDescription}
      />
      <Facts>
        <dt>{t('project.created')}</dt>
        <dd>{secondText(project.created)}</dd>
        <dt>{t('project.modified')}</dt>
        <dd>{secondText(project.modified)}</dd>
        <dt>{t('project.objects')}</dt>
        <dd>{objects?.length ?? ''}</dd>
      </Facts>
    </FormDialog>
  );
}
