import { useQueries, useQuery } from '@tanstack/react-query';
import { Tabs } from 'radix-ui';
import { Fragment, useState } from 'react';
import { api } from '@/api/client';
import { keys, objectQuery, projectQuery, queryClient, saveObjects, useObjects } from '@/api/queries';
import type { ProjectObject, ProjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { kindOf } from '@/project/kinds';
import { displayName } from '@/project/objectName';
import { useProject } from '@/project/openProject';
import { forestOf, lineage, rootsOf, subtree } from '@/project/tree';
import { Dialog } from '@/ui/Dialog';
import { Failed, Loading } from '@/ui/Empty';
import { FormDialog } from '@/ui/FormDialog';
import { guard } from '@/ui/notices';
import { ProjectFields } from '../projectInfo/ProjectFields';
import { changedObjects, withChanges, type Changes } from './model';
import styles from './ProjectSettings.module.css';

interface ProjectSettingsProps {
  projectId: string;
  /** Why nothing can be changed, or null. */
  readOnly: string | null;
  close: () => void;
}

/** All settings that a project holds: of itself, of its applications, and of other objects whose kinds have some. */
export function ProjectSettingsDialog(props: ProjectSettingsProps) {
  const t = useText();
  const project = useQuery(projectQuery(props.projectId));
  const summaries = useObjects(props.projectId);
  const forest = forestOf(summaries.data ?? []);
  const ordered = [...rootsOf(forest, 'pous'), ...rootsOf(forest, 'devices')].flatMap(({ id }) => subtree(forest, id));
  const shown = ordered.filter(({ kind }) => kindOf(kind)?.settings);
  const stored = useQueries({ queries: shown.map(({ id }) => objectQuery(props.projectId, id)) });
  const error = project.error ?? summaries.error ?? stored.find((one) => one.error)?.error;
  const objects = stored.flatMap(({ data }) => (data ? [data] : []));
  if (error || !project.data || !summaries.data || objects.length < shown.length) {
    return (
      <Dialog title={t('command.projectSettings')} width={960} onClose={props.close}>
        {error ? <Failed error={error} /> : <Loading />}
      </Dialog>
    );
  }
  return <SettingsForm {...props} project={project.data} objects={objects} />;
}

function SettingsForm({ project, objects, readOnly, close }: ProjectSettingsProps & SettingsFormProps) {
  const t = useText();
  const [name, setName] = useState(project.name);
  const [description, setDescription] = useState(project.description);
  const [changes, setChanges] = useState<Changes>({});
  const { data: summaries } = useObjects(project.id);
  const edited = withChanges(objects, changes);
  const faulty = edited.find((object) =>
    kindOf(object.kind)?.settings?.some(({ canStore }) => canStore?.(object) === false),
  );
  const refused = name.trim() === '' ? t('name.empty') : faulty && t('settings.faulty', { name: displayName(faulty) });

  const save = async () => {
    const saved = await guard(async () => {
      if (name.trim() !== project.name || description !== project.description) {
        const changed = await api.patch('/api/v1/projects/{project_id}', {
          params: { path: { project_id: project.id } },
          body: { name: name.trim(), description },
        });
        queryClient.setQueryData(keys.project(project.id), changed);
        void queryClient.invalidateQueries({ queryKey: keys.projects });
        useProject.setState({ projectName: changed.name });
      }
      const contents = changedObjects(objects, changes);
      if (contents.length > 0) await saveObjects(project.id, contents, t('command.projectSettings').replace('…', ''));
      return true;
    });
    if (saved) close();
  };
  /** Where several applications have objects of one name, the path tells them apart. */
  const headline = (object: ProjectObject) =>
    edited.some((other) => other.id !== object.id && other.name === object.name)
      ? lineage(summaries ?? [], object.id)
          .map(displayName)
          .slice(0, 2)
          .reverse()
          .join('.')
      : displayName(object);

  return (
    <FormDialog
      title={t('command.projectSettings')}
      width={960}
      onClose={close}
      onSubmit={() => void save()}
      action={t('action.save')}
      disabledReason={readOnly ?? refused}
    >
      <Tabs.Root className={styles.settings} orientation="vertical" defaultValue="project">
        <Tabs.List className={styles.pages} aria-label={t('settings.pages')}>
          <Tabs.Trigger className={styles.page} value="project">
            {t('settings.project')}
          </Tabs.Trigger>
          {edited.map((object) => (
            <Fragment key={object.id}>
              <span className={styles.owner} role="presentation">
                {headline(object)}
              </span>
              {kindOf(object.kind)?.settings?.map(({ title }) => (
                <Tabs.Trigger key={title} className={styles.page} value={`${object.id}/${title}`}>
                  {t(title)}
                </Tabs.Trigger>
              ))}
            </Fragment>
          ))}
        </Tabs.List>
        <Tabs.Content className={styles.content} value="project">
          <ProjectFields
            name={name}
            description={description}
            readOnly={readOnly !== null}
            onName={setName}
            onDescription={setDescription}
          />
        </Tabs.Content>
        {edited.map((object) =>
          kindOf(object.kind)?.settings?.map(({ title, component: Page }) => (
            <Tabs.Content key={`${object.id}/${title}`} className={styles.content} value={`${object.id}/${title}`}>
              <Page
                object={object}
                readOnly={readOnly}
                change={(data) => setChanges((before) => ({ ...before, [object.id]: data }))}
              />
            </Tabs.Content>
          )),
        )}
      </Tabs.Root>
    </FormDialog>
  );
}

interface SettingsFormProps {
  project: ProjectSummary;
  objects: readonly ProjectObject[];
}
