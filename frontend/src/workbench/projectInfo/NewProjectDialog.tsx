import { useState } from 'react';
import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { examplesQuery, keys, queryClient } from '@/api/queries';
import type { Example, ProjectSummary } from '@/api/types';
import { useText } from '@/i18n';
import { exampleText } from './exampleText';
import { openDialog } from '@/ui/dialogs';
import { freeName } from '@/project/tree';
import { FormDialog } from '@/ui/FormDialog';
import { Field, TextInput } from '@/ui/Field';
import { RadioCards, type Card } from '@/ui/RadioCards';
import { useRefusal } from '@/ui/useRefusal';

/** Asks for name and template and creates the project; undefined when cancelled. An example may be proposed. */
export function newProject(example?: Example): Promise<ProjectSummary | undefined> {
  return openDialog<ProjectSummary>((close) => <NewProjectDialog proposed={example} close={close} />);
}

const TEMPLATES = ['standard', 'motion', 'empty'] as const;

/** What a new project begins with: a template, or an example by its name. */
type Beginning = (typeof TEMPLATES)[number] | `example:${string}`;

interface NewProjectDialogProps {
  proposed: Example | undefined;
  close: (project?: ProjectSummary) => void;
}

function NewProjectDialog({ proposed, close }: NewProjectDialogProps) {
  const t = useText();
  const free = (proposal: string) => {
    const projects = queryClient.getQueryData<ProjectSummary[]>(keys.projects) ?? [];
    return freeName(
      projects.map((project) => project.name),
      proposal,
    );
  };
  const [name, setName] = useState(() => free(proposed ? exampleText(t, proposed).title : t('project.untitled')));
  const [written, setWritten] = useState(false);
  const [beginning, setBeginning] = useState<Beginning>(proposed ? `example:${proposed.name}` : 'standard');
  const { data: examples = [] } = useQuery(examplesQuery);
  const [refused, ask] = useRefusal();
  const fault = name.trim() === '' ? t('name.empty') : null;

  const create = async () => {
    const template = TEMPLATES.find((known) => known === beginning);
    const chosen = template ? { template } : { example: beginning.slice('example:'.length) };
    const project = await api.post('/api/v1/projects', { body: { name: name.trim(), ...chosen } });
    void queryClient.invalidateQueries({ queryKey: keys.projects });
    close(project);
  };

  const begin = (value: Beginning) => {
    setBeginning(value);
    if (written) return;
    const example = examples.find((known) => `example:${known.name}` === value);
    setName(free(example ? exampleText(t, example).title : t('project.untitled')));
  };
  const cards: Card<Beginning>[] = [
    ...TEMPLATES.map((value) => ({ value, name: t(`template.${value}`), effect: t(`template.${value}Text`) })),
    ...examples.map((example) => {
      const text = exampleText(t, example);
      return {
        value: `example:${example.name}` as const,
        name: t('template.example', { title: text.title }),
        effect: text.description,
      };
    }),
  ];

  return (
    <FormDialog
      title={t('command.newProject')}
      onClose={() => close()}
      onSubmit={() => void ask(create)}
      action={t('action.create')}
      disabledReason={fault}
    >
      <Field label={t('project.name')} error={refused ?? fault}>
        {(attributes) => (
          <TextInput
            {...attributes}
            data-autofocus
            value={name}
            onValue={(value) => {
              setWritten(true);
              setName(value);
            }}
          />
        )}
      </Field>
      <RadioCards label={t('project.template')} value={beginning} cards={cards} onValue={begin} />
    </FormDialog>
  );
}
