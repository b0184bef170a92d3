import { ofKind } from '@/api/objects';
import { useText } from '@/i18n';
import { objectIcon } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { useObjectSession } from '@/online/useObjectSession';
import { FormPage } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { useDraft } from '@/editors/form/useDraft';
import { Tabs } from '@/ui/Tabs';
import { BasicPage } from './BasicPage';
import { CommissioningPage } from './CommissioningPage';
import { DrivePage } from './DrivePage';
import { GenericDrivePage } from './GenericDrivePage';
import { InformationPage } from './InformationPage';
import { LogicalPage } from './LogicalPage';
import { canStore } from './model';
import { mayEdit, mayChangeText } from '@/workbench/rights';
import { reasonText } from '@/workbench/run';
import { useCommandContext } from '@/workbench/useCommandContext';
import { ParametersPage } from './ParametersPage';
import { PositionControlPage } from './PositionControlPage';
import { ScalingPage } from './ScalingPage';
import { StatusPage } from './StatusPage';
import { isTunable } from './tuning';
import { TuningPage } from './TuningPage';

const AxisIcon = objectIcon('axis');
const NO_OTHERS = {};

/**
 * The pages of an axis (devices.md, 14.2 to 14.5). Settings are typed while logged out; what was measured while logged in is taken
 * into them, and taken back by Undo.
 */
export default function AxisEditor({ panelId, projectId, objectId, reveal }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('axis'), canStore, NO_OTHERS, mayChangeText);
  const mayType = mayEdit(useCommandContext());
  const readOnly = mayType === true ? null : reasonText(mayType);
  const session = useObjectSession(projectId, draft.object);
  const name = draft.object?.name ?? '';
  const form = (Page: typeof BasicPage) => (
    <FormPage draft={{ ...draft, readOnly }}>
      {(axis) => (
        <>
          <h1 className={styles.title}>
            <AxisIcon size={20} />
            {name}
          </h1>
          <Page
            projectId={projectId}
            objectId={objectId}
            axis={axis}
            disabled={readOnly !== null}
            change={(changes) => draft.change({ ...axis, ...changes })}
          />
        </>
      )}
    </FormPage>
  );
  const drive = draft.data?.drive;
  const settings =
    drive === 'SM_Drive_Logical'
      ? [{ id: 'basic', title: t('axis.page.logical'), content: form(LogicalPage) }]
      : [
          { id: 'basic', title: t('axis.page.basic'), content: form(BasicPage) },
          { id: 'scaling', title: t('axis.page.scaling'), content: form(ScalingPage) },
        ];
  if (drive === 'SM_Drive_Simulated')
    settings.push({ id: 'drive', title: t('axis.page.drive'), content: form(DrivePage) });
  if (drive === 'SM_Drive_GenericDSP402')
    settings.push({ id: 'drive', title: t('axis.page.drive'), content: form(GenericDrivePage) });
  if (drive === 'SM_Drive_PosControl')
    settings.push({ id: 'control', title: t('axis.page.control'), content: form(PositionControlPage) });
  const pages = [
    ...settings,
    {
      id: 'commissioning',
      title: t('axis.page.commissioning'),
      content: <CommissioningPage session={session} name={name} settings={draft.data} />,
    },
    ...(draft.data !== undefined && isTunable(draft.data)
      ? [
          {
            id: 'tuning',
            title: t('axis.page.tuning'),
            content: (
              <TuningPage
                session={session}
                name={name}
                settings={draft.data}
                readOnly={draft.readOnly}
                change={draft.change}
              />
            ),
          },
        ]
      : []),
    { id: 'parameters', title: t('axis.page.parameters'), content: <ParametersPage session={session} name={name} /> },
    { id: 'status', title: t('axis.page.status'), content: <StatusPage session={session} name={name} /> },
    {
      id: 'information',
      title: t('axis.page.information'),
      content: <InformationPage name={name} drive={drive} />,
    },
  ];
  const channel = reveal?.part === 'implementation'; // Messages of the build about a channel of the drive
  return <Tabs key={channel ? reveal.serial : 0} pages={pages} initial={channel ? 'scaling' : 'basic'} />;
}
