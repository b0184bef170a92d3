import { Plus } from 'lucide-react';
import { ofKind } from '@/api/objects';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { kindTitle, objectIcon } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { FormPage, Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { useDraft } from '@/editors/form/useDraft';
import { Button } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { openObject } from '@/workbench/docking/dock';
import { runCommand } from '@/workbench/run';
import { BusTaskField } from '../axis/BusTaskField';

const PoolIcon = objectIcon('axis_pool');
const AxisIcon = objectIcon('axis');
const canStore = () => true;

/** The bus task of all axes of the pool, and the axes. */
export default function AxisPoolEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('axis_pool'), canStore);
  const { data: objects } = useObjects(projectId);
  const axes = (objects ?? []).filter((object) => object.parent_id === objectId).sort((a, b) => a.index - b.index);
  return (
    <FormPage draft={draft}>
      {(pool) => (
        <>
          <h1 className={styles.title}>
            <PoolIcon size={20} />
            {kindTitle('axis_pool')}
          </h1>
          <Section title={t('axisPool.task')}>
            <div className={styles.fields}>
              <BusTaskField
                projectId={projectId}
                objectId={objectId}
                value={pool.bus_task}
                automatic={t('axisPool.automatic')}
                disabled={draft.readOnly !== null}
                onValue={(bus_task) => draft.change({ ...pool, bus_task })}
              />
            </div>
          </Section>
          <Section
            title={t('axisPool.axes')}
            tools={
              <Button
                icon={Plus}
                disabledReason={draft.readOnly}
                onClick={() =>
                  void runCommand('project.addObject', { kind: 'axis', parentId: objectId, view: 'devices' })
                }
              >
                {t('axisPool.add')}
              </Button>
            }
          >
            {axes.length === 0 ? (
              <Empty title={t('axisPool.none')} text={t('axisPool.noneText')} />
            ) : (
              <div className={styles.tools}>
                {axes.map((axis) => (
                  <Button key={axis.id} icon={AxisIcon} onClick={() => openObject(axis.id, axis.name)}>
                    {axis.name}
                  </Button>
                ))}
              </div>
            )}
          </Section>
        </>
      )}
    </FormPage>
  );
}
