import { ofKind } from '@/api/objects';
import { useText } from '@/i18n';
import { FormPage } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { useDraft } from '@/editors/form/useDraft';
import { useObjectSession } from '@/online/useObjectSession';
import type { EditorProps } from '@/project/editorProps';
import { objectIcon } from '@/project/kinds';
import { Tabs } from '@/ui/Tabs';
import { AxesPage } from './AxesPage';
import { FramesPage } from './FramesPage';
import { KinematicsPage } from './KinematicsPage';
import { LimitsPage } from './LimitsPage';
import { canStore } from './model';
import { OnlinePage } from './OnlinePage';

const GroupIcon = objectIcon('axis_group');

/** The pages of an axis group: settings are typed while logged out, its queue and values are seen while logged in. */
export default function AxisGroupEditor({ panelId, projectId, objectId, reveal }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('axis_group'), canStore);
  const session = useObjectSession(projectId, draft.object);
  const name = draft.object?.name ?? '';
  const form = (Page: typeof AxesPage) => (
    <FormPage draft={draft}>
      {(group) => (
        <>
          <h1 className={styles.title}>
            <GroupIcon size={20} />
            {name}
          </h1>
          <Page
            projectId={projectId}
            objectId={objectId}
            group={group}
            disabled={draft.readOnly !== null}
            change={(changes) => draft.change({ ...group, ...changes })}
          />
        </>
      )}
    </FormPage>
  );
  const pages = [
    { id: 'axes', title: t('axisGroup.page.axes'), content: form(AxesPage) },
    { id: 'kinematics', title: t('axisGroup.page.kinematics'), content: form(KinematicsPage) },
    { id: 'limits', title: t('axisGroup.page.limits'), content: form(LimitsPage) },
    { id: 'frames', title: t('axisGroup.page.frames'), content: form(FramesPage) },
    {
      id: 'online',
      title: t('axisGroup.page.online'),
      content: <OnlinePage session={session} name={name} axes={draft.data?.axes ?? []} />,
    },
  ];
  return <Tabs key={reveal?.serial ?? 0} pages={pages} initial="axes" />;
}
