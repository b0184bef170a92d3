import { useState } from 'react';
import { api, ApiError } from '@/api/client';
import { keys, queryClient } from '@/api/queries';
import type { Diagnostic, LibrarySummary } from '@/api/types';
import { useText } from '@/i18n';
import { showPanel } from '../docking/dock';
import { buildFinished } from '../messages/store';
import { notify, notifyError } from '@/ui/notices';
import { FormDialog } from '@/ui/FormDialog';
import { Checkbox, Field, TextInput } from '@/ui/Field';
import { idOf, libraryFaults, nextVersion } from './model';

interface SaveLibraryDialogProps {
  projectId: string;
  projectName: string;
  description: string;
  installed: readonly LibrarySummary[];
  close: () => void;
}

/** Makes a library of the project: everything but its programs, provided that it compiles. */
export function SaveLibraryDialog({ projectId, projectName, description, installed, close }: SaveLibraryDialogProps) {
  const t = useText();
  const [facts, setFacts] = useState(() => ({
    name: projectName,
    version: nextVersion(projectName, installed),
    namespace: '',
    qualified_only: false,
    company: installed.find((library) => library.name === projectName)?.company ?? '',
    description,
  }));
  const [saving, setSaving] = useState(false);
  const faults = libraryFaults(facts, installed);
  const set = (part: Partial<typeof facts>) => setFacts({ ...facts, ...part });
  const save = async () => {
    if (saving || Object.values(faults).some(Boolean)) return;
    setSaving(true);
    try {
      const saved = await api.post('/api/v1/projects/{project_id}/library', {
        params: { path: { project_id: projectId } },
        body: facts,
      });
      await queryClient.invalidateQueries({ queryKey: keys.libraries });
      notify({ tone: 'ok', title: t('libraries.saved', { name: idOf(saved) }) });
      close();
    } catch (error) {
      if (error instanceof ApiError && Array.isArray(error.problem.diagnostics)) {
        showErrors(projectName, error.problem.diagnostics as Diagnostic[]);
        notify({ tone: 'error', title: t('libraries.notSaved'), text: t('libraries.notSavedText') });
        close();
      } else {
        notifyError(error);
        setSaving(false);
      }
    }
  };

  return (
    <FormDialog
      title={t('command.saveLibrary')}
      description={t('libraries.saveText')}
      width={480}
      onClose={close}
      onSubmit={() => void save()}
      action={t('libraries.save')}
      disabledReason={saving ? t('reason.busy') : null}
    >
      <Field label={t('library.name')} error={faults.name && t(faults.name)}>
        {(attributes) => <TextInput {...attributes} value={facts.name} onValue={(name) => set({ name })} />}
      </Field>
      <Field
        label={t('library.version')}
        error={faults.version && t(faults.version)}
        hint={replaces(facts, installed) ? t('libraries.replaces') : undefined}
      >
        {(attributes) => <TextInput {...attributes} value={facts.version} onValue={(version) => set({ version })} />}
      </Field>
      <Field label={t('libraries.company')}>
        {(attributes) => <TextInput {...attributes} value={facts.company} onValue={(company) => set({ company })} />}
      </Field>
      <Field
        label={t('library.namespace')}
        error={faults.namespace && t(faults.namespace)}
        hint={t('libraries.namespaceHint')}
      >
        {(attributes) => (
          <TextInput
            {...attributes}
            className="code"
            value={facts.namespace}
            placeholder={facts.name.replace(/\W+/g, '_')}
            onValue={(namespace) => set({ namespace })}
          />
        )}
      </Field>
      <Checkbox checked={facts.qualified_only} onChecked={(qualified_only) => set({ qualified_only })}>
        {t('libraries.qualifiedOnly')}
      </Checkbox>
      <Field label={t('libraries.description')}>
        {(attributes) => (
          <TextInput {...attributes} value={facts.description} onValue={(text) => set({ description: text })} />
        )}
      </Field>
    </FormDialog>
  );
}

function replaces(facts: { name: string; version: string }, installed: readonly LibrarySummary[]): boolean {
  return installed.some((library) => library.name === facts.name && library.version === facts.version);
}

/** What stands in the way, in the messages as after a build. */
function showErrors(name: string, diagnostics: Diagnostic[]): void {
  const report = { ok: false, diagnostics, code_id: null, data_id: null, code_size: null, data_size: null, seconds: 0 };
  buildFinished({ applicationId: '', applicationName: name, report, at: Date.now() });
  showPanel('messages', false);
}
