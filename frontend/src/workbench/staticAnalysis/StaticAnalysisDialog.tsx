import { useState } from 'react';
import { shaped } from '@/api/objects';
import { objectQuery, queryClient, saveObject, useObject } from '@/api/queries';
import type { CodingRule, ObjectOf, ObjectSummary, Schemas, StaticAnalysisData } from '@/api/types';
import { useText } from '@/i18n';
import { ofRole } from '@/project/kinds';
import { guard } from '@/ui/notices';
import { Dialog } from '@/ui/Dialog';
import { FormDialog } from '@/ui/FormDialog';
import { Failed, Loading } from '@/ui/Empty';
import { Checkbox, Field, Select } from '@/ui/Field';
import { NO_RULES, onIn, prefixesFit } from './model';
import { RulesEditor } from './RulesEditor';
import { useRules } from './useRules';
import styles from './StaticAnalysis.module.css';

interface StaticAnalysisDialogProps {
  projectId: string;
  applications: readonly ObjectSummary[];
  /** The application that is shown first. */
  applicationId: string;
  /** Why nothing can be changed, or null. */
  readOnly: string | null;
  close: (saved?: boolean) => void;
}

/** Which coding rules are checked in an application, how strictly, with which prefixes and limits. */
export function StaticAnalysisDialog(props: StaticAnalysisDialogProps) {
  const { projectId, applications, close } = props;
  const t = useText();
  const [applicationId, setApplicationId] = useState(props.applicationId);
  const application = useObject(projectId, applicationId, ofRole('application'));
  const rules = useRules();
  const error = application.error ?? rules.error;
  if (error || !application.data || !rules.data) {
    return (
      <Dialog title={t('command.staticAnalysisSettings')} width={860} onClose={() => close()}>
        {error ? <Failed error={error} /> : <Loading />}
      </Dialog>
    );
  }
  return (
    <SettingsForm
      key={applicationId}
      projectId={projectId}
      application={application.data}
      applications={applications}
      rules={rules.data}
      readOnly={props.readOnly}
      choose={setApplicationId}
      close={close}
    />
  );
}

interface SettingsFormProps {
  projectId: string;
  application: ObjectOf<Schemas['ApplicationData']>;
  applications: readonly ObjectSummary[];
  rules: readonly CodingRule[];
  readOnly: string | null;
  choose: (applicationId: string) => void;
  close: (saved?: boolean) => void;
}

function SettingsForm({ projectId, application, applications, rules, readOnly, choose, close }: SettingsFormProps) {
  const t = useText();
  const [chosen, setChosen] = useState<StaticAnalysisData>(application.data.static_analysis ?? NO_RULES);
  const [everywhere, setEverywhere] = useState(false);
  const save = async () => {
    const targets = everywhere ? applications.map((one) => one.id) : [application.id];
    const done = await guard(async () => {
      for (const id of targets) await saveSettings(projectId, id, chosen);
      return true;
    });
    if (done) close(true);
  };

  return (
    <FormDialog
      title={t('command.staticAnalysisSettings')}
      width={860}
      onClose={() => close()}
      onSubmit={() => void save()}
      action={t('action.apply')}
      disabledReason={readOnly ?? (prefixesFit(chosen) ? null : t('analysis.prefixFault'))}
      aside={
        <>
          <span className={styles.count}>{t('analysis.on', { on: onIn(chosen, rules), all: rules.length })}</span>
          {applications.length > 1 && (
            <Checkbox checked={everywhere} onChecked={setEverywhere}>
              {t('analysis.everywhere')}
            </Checkbox>
          )}
        </>
      }
    >
      <div className={styles.bar}>
        {applications.length > 1 && (
          <Field label={t('kind.application')} row>
            {(attributes) => (
              <Select
                {...attributes}
                value={application.id}
                choices={applications.map((one) => ({ value: one.id, text: one.name }))}
                onValue={choose}
              />
            )}
          </Field>
        )}
        <Checkbox
          checked={chosen.with_build}
          disabled={readOnly !== null}
          onChecked={(with_build) => setChosen({ ...chosen, with_build })}
        >
          {t('analysis.withBuild')}
        </Checkbox>
      </div>
      <RulesEditor rules={rules} chosen={chosen} readOnly={readOnly} change={setChosen} />
    </FormDialog>
  );
}

async function applicationNow(projectId: string, applicationId: string) {
  const stored = await queryClient.fetchQuery({ ...objectQuery(projectId, applicationId), staleTime: 0 });
  return shaped(stored, ofRole('application'));
}

/** Stores the choice on top of what the application is now. */
async function saveSettings(projectId: string, applicationId: string, chosen: StaticAnalysisData): Promise<void> {
  const now = await applicationNow(projectId, applicationId);
  await saveObject(projectId, applicationId, now.revision, { ...now.data, static_analysis: chosen });
}

/** The stored choice of an application. */
export async function storedRules(projectId: string, applicationId: string): Promise<StaticAnalysisData> {
  return (await applicationNow(projectId, applicationId)).data.static_analysis ?? NO_RULES;
}
