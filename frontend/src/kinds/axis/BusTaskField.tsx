import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { applicationOf, forestOf, subtree } from '@/project/tree';
import { Field, Select } from '@/ui/Field';

interface BusTaskProps {
  projectId: string;
  /** The object that the choice belongs to. */
  objectId: string;
  value: string;
  /** What holds without a choice. */
  automatic: string;
  disabled: boolean;
  onValue: (task: string) => void;
}

/** Stands for no choice: a choice of the list needs a value. */
const AUTOMATIC = ' ';

/** The task that moves axes; one that is gone is still shown, with what is wrong. */
export function BusTaskField({ projectId, objectId, value, automatic, disabled, onValue }: BusTaskProps) {
  const t = useText();
  const { data: objects } = useObjects(projectId);
  const application = objects && applicationOf(objects, objectId);
  const tasks = application
    ? subtree(forestOf(objects), application.id)
        .filter((object) => object.kind === 'task')
        .map((task) => task.name)
    : [];
  const chosen = tasks.find((task) => task.toUpperCase() === value.toUpperCase());
  const gone = value !== '' && objects !== undefined && chosen === undefined;
  return (
    <Field
      row
      label={t('axis.busTask')}
      hint={t('axis.busTaskHint')}
      error={gone ? t('axis.noTask', { name: value }) : null}
    >
      {(attributes) => (
        <Select
          {...attributes}
          disabled={disabled}
          value={value === '' ? AUTOMATIC : (chosen ?? value)}
          choices={[
            { value: AUTOMATIC, text: automatic },
            ...[...tasks, ...(gone ? [value] : [])].map((task) => ({ value: task, text: task })),
          ]}
          onValue={(task) => onValue(task === AUTOMATIC ? '' : task)}
        />
      )}
    </Field>
  );
}
