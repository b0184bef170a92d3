import { useQuery } from '@tanstack/react-query';
import { ChevronRight, Search } from 'lucide-react';
import { useRef, useState } from 'react';
import { api } from '@/api/client';
import { shaped } from '@/api/objects';
import { objectQuery, queryClient, saveObject, useObject } from '@/api/queries';
import type { CodingRule, ObjectOf, ObjectSummary, Schemas, StaticAnalysisData } from '@/api/types';
import { useLanguage, useText } from '@/i18n';
import { ofRole } from '@/project/kinds';
import { guard } from '@/ui/notices';
import { useToggleSet } from '@/ui/toggleSet';
import { Button } from '@/ui/Button';
import { Dialog } from '@/ui/Dialog';
import { FormDialog } from '@/ui/FormDialog';
import { Empty, Failed, Loading } from '@/ui/Empty';
import { Checkbox, Field, Select } from '@/ui/Field';
import { groupKey, groupsOf, isPrefix, NO_RULES, onIn, titleKey, withLevel, type Level } from './model';
import { RuleRow } from './RuleRow';
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
  const language = useLanguage();
  const [applicationId, setApplicationId] = useState(props.applicationId);
  const application = useObject(projectId, applicationId, ofRole('application'));
  const rules = useQuery({
    queryKey: ['static-analysis', 'rules', language],
    queryFn: () => api.get('/api/v1/static-analysis/rules', { params: { query: { language } } }),
    staleTime: Infinity,
  });
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
  const [search, setSearch] = useState('');
  const [closed, toggle] = useToggleSet<string>();
  const [everywhere, setEverywhere] = useState(false);
  const list = useRef<HTMLDivElement>(null);
  const groups = groupsOf(rules, search, (code) => t(titleKey(code)));
  const shown = groups.flatMap((group) => group.rules);
  const faulty = Object.values(chosen.prefixes).some((prefix) => !isPrefix(prefix));
  const setAll = (level: Level) => {
    const codes = shown.map((rule) => rule.code);
    setChosen(withLevel(chosen, level === 'off' ? codes : codes.filter((code) => !chosen.rules[code]), level));
  };
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
      disabledReason={readOnly ?? (faulty ? t('analysis.prefixFault') : null)}
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
      <div className={styles.bar}>
        <div className={styles.search}>
          <Search size={13} aria-hidden />
          <input
            data-autofocus
            value={search}
            placeholder={t('analysis.search')}
            aria-label={t('analysis.search')}
            spellCheck={false}
            onChange={(event) => {
              setSearch(event.target.value);
              if (list.current) list.current.scrollTop = 0;
            }}
            onKeyDown={(event) => event.key === 'Enter' && event.preventDefault()}
          />
        </div>
        <Button disabledReason={readOnly} onClick={() => setAll('warning')}>
          {t('analysis.allOn')}
        </Button>
        <Button disabledReason={readOnly} onClick={() => setAll('off')}>
          {t('analysis.allOff')}
        </Button>
        <Button disabledReason={readOnly} onClick={() => setChosen(NO_RULES)}>
          {t('analysis.defaults')}
        </Button>
      </div>
      <div className={styles.list} ref={list}>
        {groups.length === 0 && <Empty title={t('tree.nothingFound', { text: search.trim() })} />}
        {groups.map((group) => {
          const open = !closed.has(group.id);
          return (
            <section key={group.id} aria-label={t(groupKey(group.id))}>
              <button
                type="button"
                className={styles.group}
                aria-expanded={open}
                data-open={open ? '' : undefined}
                onClick={() => toggle(group.id)}
              >
                <ChevronRight size={14} strokeWidth={1.75} aria-hidden />
                {t(groupKey(group.id))}
                <span className={styles.muted}>
                  {t('analysis.on', { on: onIn(chosen, group.rules), all: group.rules.length })}
                </span>
              </button>
              {open &&
                group.rules.map((rule) => (
                  <RuleRow
                    key={rule.code}
                    rule={rule}
                    chosen={chosen}
                    readOnly={readOnly !== null}
                    change={setChosen}
                  />
                ))}
            </section>
          );
        })}
      </div>
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
