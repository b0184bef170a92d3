import { useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ProjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { freeName } from '@/project/tree';
import { FormDialog } from '@/ui/FormDialog';
import { Field, TextInput } from '@/ui/Field';
import { RadioCards } from '@/ui/RadioCards';
import { useRefusal } from '@/ui/useRefusal';

/** Asks for name and template and creates the project; undefined when cancelled. */
export function newProject(): Promise<ProjectSummary | undefined> {
  return openDialog<ProjectSummary>((close) => <NewProjectDialog close={close} />);
}

const TEMPLATES = ['standard', 'motion', 'empty'] as const;

function NewProjectDialog({ close }: { close: (project?: ProjectSummary) => void }) {
  const t = useText();
  const [name, setName] = useState(() => {
    const projects = queryClient.getQueryData<ProjectSummary[]>(keys.projects) ?? [];
    return freeName(
      projects.map((project) => project.name),
      t('project.untitled'),
    );
  });
  const [template, setTemplate] = useState<(typeof TEMPLATES)[number]>('standard');
  const [refused, ask] = useRefusal();
  const fault = name.trim() === '' ? t('name.empty') : null;

  const create = async () => {
    const project = await api.post('/api/v1/projects', { body: { name: name.trim(), template } });
    void queryClient.invalidateQueries({ queryKey: keys.projects });
    close(project);
  };

  return (
    <FormDialog
      title={t('command.newProject')}
      onClose={() => close()}
      onSubmit={() => void ask(create)}
      action={t('action.create')}
      disabledReason={fault}
    >
      <Field label={t('project.name')} error={refused ?? fault}>
        {(attributes) => <TextInput {...attributes} data-autofocus value={name} onValue={setName} />}
      </Field>
      <RadioCards
        label={t('project.template')}
        value={template}
        cards={TEMPLATES.map((value) => ({
          value,
          name: t(`template.${value}`),
          effect: t(`template.${value}Text`),
        }))}
        onValue={setTemplate}
      />
    </FormDialog>
  );
}
