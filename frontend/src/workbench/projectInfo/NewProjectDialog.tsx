import { useState } from 'react';
import { api } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { ProjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { openDialog } from '@/ui/dialogs';
import { refusalOf } from '@/ui/notices';
import { freeName } from '@/project/tree';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { Field, TextInput } from '@/ui/Field';
import { RadioCards } from '@/ui/RadioCards';

/** Asks for name and template and creates the project; undefined when cancelled. */
export function newProject(): Promise<ProjectSummary | undefined> {
  return openDialog<ProjectSummary>((close) => <NewProjectDialog close={close} />);
}

const TEMPLATES = ['standard', 'empty'] as const;

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
  const [refused, setRefused] = useState<string | null>(null);
  const fault = name.trim() === '' ? t('name.empty') : null;

  const create = async () => {
    if (fault) return;
    try {
      const project = await api.post('/api/v1/projects', { body: { name: name.trim(), template } });
      void queryClient.invalidateQueries({ queryKey: keys.projects });
      close(project);
    } catch (error) {
      setRefused(refusalOf(error));
    }
  };

  return (
    <Dialog
      title={t('command.newProject')}
      onClose={() => close()}
      onSubmit={() => void create()}
      footer={
        <>
          <Button onClick={() => close()}>{t('action.cancel')}</Button>
          <Button type="submit" variant="primary" disabledReason={fault}>
            {t('action.create')}
          </Button>
        </>
      }
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
    </Dialog>
  );
}
