import { ArrowDown, ArrowUp, Plus, Trash2 } from 'lucide-react';
import { useQueries } from '@tanstack/react-query';
import { ofKind, shaped } from '@/api/objects';
import { objectQuery, useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { Section } from '@/editors/form/FormPage';
import form from '@/editors/form/Form.module.css';
import { applicationOf, forestOf, subtree } from '@/project/tree';
import { Button, IconButton } from '@/ui/Button';
import { Empty } from '@/ui/Empty';
import { Select } from '@/ui/Field';
import styles from './AxisGroup.module.css';
import { axisRows, MOST_AXES, moved, nextAxis, type AxisChoice, type GroupPageProps } from './model';

/** Stands for no choice: a choice of the list needs a value. */
const NONE = ' ';

/** The axes of the group by their index, chosen from those of the application (AG-01, AG-02). */
export function AxesPage({ projectId, objectId, group, disabled, change }: GroupPageProps) {
  const t = useText();
  const choices = useAxisChoices(projectId, objectId);
  const rows = axisRows(group.axes, choices);
  const set = (axes: readonly string[]) => change({ axes: [...axes] });
  const readOnly = disabled ? t('axisGroup.readOnly') : null;
  const full = group.axes.length >= MOST_AXES ? t('axisGroup.full') : null;
  return (
    <Section
      title={t('axisGroup.axes')}
      tools={
        <Button
          icon={Plus}
          disabledReason={readOnly ?? full}
          onClick={() => set([...group.axes, nextAxis(group.axes, choices)])}
        >
          {t('axisGroup.add')}
        </Button>
      }
    >
      <p className={form.note}>{t('axisGroup.axesText')}</p>
      {rows.length === 0 ? (
        <Empty title={t('axisGroup.none')} text={t('axisGroup.noneText')} />
      ) : (
        <ol className={styles.rows}>
          {rows.map((row, index) => (
            <li key={index} className={styles.row}>
              <span className="digits">{index + 1}</span>
              <Select
                label={t('axisGroup.axisOf', { index: index + 1 })}
                disabled={disabled}
                value={row.name === '' ? NONE : row.name}
                choices={[
                  { value: NONE, text: t('axisGroup.choose') },
                  ...[...new Set([...choices.map((axis) => axis.name), ...(row.name ? [row.name] : [])])].map(
                    (name) => ({ value: name, text: name }),
                  ),
                ]}
                onValue={(name) => set(group.axes.map((old, at) => (at === index ? name.trim() : old)))}
              />
              <span className={styles.acts}>
                <IconButton
                  icon={ArrowUp}
                  small
                  label={t('axisGroup.up', { index: index + 1 })}
                  disabledReason={readOnly ?? (index === 0 ? t('reason.first') : null)}
                  onClick={() => set(moved(group.axes, index, -1))}
                />
                <IconButton
                  icon={ArrowDown}
                  small
                  label={t('axisGroup.down', { index: index + 1 })}
                  disabledReason={readOnly ?? (index === rows.length - 1 ? t('reason.last') : null)}
                  onClick={() => set(moved(group.axes, index, 1))}
                />
                <IconButton
                  icon={Trash2}
                  small
                  label={t('axisGroup.remove', { index: index + 1 })}
                  disabledReason={readOnly}
                  onClick={() => set(group.axes.filter((_, at) => at !== index))}
                />
              </span>
              {row.fault && (
                <span className={styles.fault} role="alert">
                  {t(row.fault.text, { axis: row.name, group: row.fault.group ?? '' })}
                </span>
              )}
            </li>
          ))}
        </ol>
      )}
    </Section>
  );
}

/** The axes of the application, each with the other group that has it. */
function useAxisChoices(projectId: string, objectId: string): AxisChoice[] {
  const { data: objects } = useObjects(projectId);
  const application = objects && applicationOf(objects, objectId);
  const below = application ? subtree(forestOf(objects), application.id) : [];
  const others = below.filter((object) => object.kind === 'axis_group' && object.id !== objectId);
  const groups = useQueries({
    queries: others.map((other) => ({
      ...objectQuery(projectId, other.id),
      select: (object: Parameters<typeof shaped>[0]) => shaped(object, ofKind('axis_group')).data,
    })),
  });
  const owner = (name: string) =>
    others.find((_, at) => groups[at]?.data?.axes.some((axis) => axis.toUpperCase() === name.toUpperCase()))?.name ??
    null;
  return below.filter((object) => object.kind === 'axis').map((axis) => ({ name: axis.name, group: owner(axis.name) }));
}
