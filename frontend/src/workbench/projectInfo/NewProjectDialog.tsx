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
import choice from '../online/dialogs.module.css';

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
      <div role="radiogroup" aria-label={t('project.template')} className={choice.choices}>
        {TEMPLATES.map((each) => (
          <button
            key={each}
            type="button"
            role="radio"
            aria-checked={each === template}
            className={choice.choice}
            onClick={() => setTemplate(each)}
          >
            <span className={choice.radio} />
            <span>
              <span className={choice.name}>{t(`template.${each}`)}</span>
              <span className={choice.effect}>{t(`template.${each}Text`)}</span>
            </span>
          </button>
        ))}
      </div>
    </Dialog>
  );
}
