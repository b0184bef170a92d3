import { Plus } from 'lucide-react';
import { useMemo, useState } from 'react';
import { useQueries } from '@tanstack/react-query';
import { ofKind, shaped } from '@/api/objects';
import { objectQuery, useObjects } from '@/api/queries';
import type { ObjectSummary, ProjectObject, TaskConfigurationData, TaskData } from '@/api/types';
import { listed, useText } from '@/i18n';
import { objectIcon } from '@/project/kinds';
import { useCommandContext } from '@/workbench/useCommandContext';
import { openObject } from '@/workbench/docking/dock';
import type { EditorProps } from '@/project/editorProps';
import { useOnline } from '@/workbench/onlineSession';
import { mayEdit } from '@/workbench/rights';
import { reasonText, runCommand } from '@/workbench/run';
import { applicationOf } from '@/project/tree';
import { Button } from '@/ui/Button';
import { Empty, Loading } from '@/ui/Empty';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { Tabs } from '@/ui/Tabs';
import { Section } from '@/editors/form/FormPage';
import { useDraft, type Draft } from '@/editors/form/useDraft';
import styles from '@/editors/form/Form.module.css';
import { intervalNs } from '../task/model';
import { canStore } from './events';
import { GroupsSection } from './GroupsSection';
import { MonitoringPage } from './MonitoringPage';
import { SystemEventsPage } from './SystemEventsPage';
import { TargetSection } from './TargetSection';
import { useLoad } from './useLoad';

interface TaskLine {
  object: ObjectSummary;
  task: TaskData | undefined;
}

const ConfigurationIcon = objectIcon('task_configuration');

/** The tasks of an application; online also their measured times (tasks.md, sections 1 and 5). */
export default function TaskConfigurationEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('task_configuration'), canStore);
  const { data: objects } = useObjects(projectId);
  const application = objects && applicationOf(objects, objectId);
  const session = useOnline((state) => (application ? state.sessions[application.id] : undefined));
  if (!objects) return <Loading />;
  const pages = [
    {
      id: 'properties',
      title: t('taskConfiguration.properties'),
      content: (
        <Overview
          projectId={projectId}
          objectId={objectId}
          objects={objects}
          draft={draft}
          runtimeId={session?.runtimeId ?? null}
        />
      ),
    },
    {
      id: 'events',
      title: t('taskConfiguration.systemEvents'),
      content: (
        <SystemEventsPage
          draft={draft}
          projectId={projectId}
          objectId={objectId}
          runtimeId={session?.runtimeId ?? null}
        />
      ),
    },
  ];
  if (session)
    pages.push({
      id: 'monitoring',
      title: t('taskConfiguration.monitoring'),
      content: <MonitoringPage runtimeId={session.runtimeId} />,
    });
  return <Tabs key={session ? 'online' : 'offline'} pages={pages} initial={session ? 'monitoring' : 'properties'} />;
}

function Overview({
  projectId,
  objectId,
  objects,
  draft,
  runtimeId,
}: {
  projectId: string;
  objectId: string;
  objects: readonly ObjectSummary[];
  draft: Draft<TaskConfigurationData>;
  runtimeId: string | null;
}) {
  const t = useText();
  const [selected, setSelected] = useState<string | null>(null);
  const tasks = useMemo(
    () =>
      objects
        .filter((object) => object.parent_id === objectId && object.kind === 'task')
        .sort((a, b) => a.index - b.index),
    [objects, objectId],
  );
  const data = useQueries({
    queries: tasks.map((task) => ({
      ...objectQuery(projectId, task.id),
      select: (object: ProjectObject) => shaped(object, ofKind('task')).data,
    })),
  });
  const lines = tasks.map((object, at): TaskLine => ({ object, task: data[at]?.data }));
  const { data: load } = useLoad(runtimeId);
  const allowed = mayEdit(useCommandContext());
  const refused = allowed === true ? null : reasonText(allowed);
  const add = () => void runCommand('project.addObject', { kind: 'task', parentId: objectId, view: 'devices' });
  const when = ({ task }: TaskLine) =>
    !task ? '' : task.type === 'cyclic' ? task.interval : task.type === 'freewheeling' ? '' : task.event;
  const columns: Column<TaskLine>[] = [
    {
      id: 'name',
      title: t('tasks.task'),
      width: 150,
      sort: (line) => line.object.name,
      cell: (line) => <span>{line.object.name}</span>,
    },
    {
      id: 'priority',
      title: t('task.priority'),
      width: 80,
      align: 'right',
      sort: (line) => line.task?.priority ?? 99,
      cell: (line) => <span>{line.task?.priority}</span>,
    },
    {
      id: 'type',
      title: t('task.type'),
      width: 130,
      sort: (line) => line.task?.type ?? '',
      cell: (line) => <span>{line.task && t(`taskType.${line.task.type}`)}</span>,
    },
    {
      id: 'when',
      title: t('taskConfiguration.when'),
      width: 150,
      sort: (line) => intervalNs(when(line)) ?? 0,
      cell: (line) => <span className="code">{when(line)}</span>,
    },
    {
      id: 'programs',
      title: t('task.programs'),
      width: 200,
      grow: true,
      cell: (line) => <span>{line.task && listed(line.task.pous.map((pou) => pou.name))}</span>,
    },
  ];
  return (
    <div className={styles.page}>
      <div className={styles.inner}>
        <h1 className={styles.title}>
          <ConfigurationIcon size={20} />
          {t('kind.task_configuration')}
        </h1>
        <Section
          title={t('taskConfiguration.tasks', { count: tasks.length })}
          tools={
            <Button icon={Plus} disabledReason={refused} onClick={add}>
              {t('taskConfiguration.addTask')}
            </Button>
          }
        >
          <div className={styles.box} style={{ height: Math.min(420, 29 + Math.max(4, lines.length) * 26) }}>
            <Table
              label={t('taskConfiguration.tasks', { count: tasks.length })}
              items={lines}
              columns={columns}
              keyOf={(line) => line.object.id}
              selected={selected}
              onSelect={(line) => setSelected(line?.object.id ?? null)}
              onOpen={(line) => openObject(line.object.id, line.object.name)}
              empty={<Empty title={t('taskConfiguration.none')} text={t('taskConfiguration.noneText')} />}
            />
          </div>
        </Section>
        <GroupsSection
          draft={draft}
          tasks={lines.map(({ object, task }) => ({ name: object.name, group: task?.group ?? '' }))}
          there={load?.processors ?? null}
        />
        <TargetSection />
      </div>
    </div>
  );
}
