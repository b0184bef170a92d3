import { CircleCheckBig, Hammer, LogIn } from 'lucide-react';
import { useMemo } from 'react';
import { ofKind } from '@/api/objects';
import { useObjects } from '@/api/queries';
import { useText } from '@/i18n';
import { kindOf, objectIcon, type ContentGroup } from '@/project/kinds';
import type { EditorProps } from '@/project/editorProps';
import { bytesText, countOf, useMessages } from '@/workbench/messages/store';
import { runtimeText } from '@/workbench/online/runtimeText';
import { useOnline } from '@/workbench/onlineSession';
import { setActiveApplication, useProject } from '@/project/openProject';
import { runCommand } from '@/workbench/run';
import { forestOf, subtree } from '@/project/tree';
import { Facts } from '@/ui/Facts';
import { Button } from '@/ui/Button';
import { FormPage, Section } from '@/editors/form/FormPage';
import styles from '@/editors/form/Form.module.css';
import { useDraft } from '@/editors/form/useDraft';
import { HeapFields } from './HeapFields';
import { ReserveFields } from './ReserveFields';
import { SourceFields } from './SourceFields';
import { canStore } from './heap';
import { usableReserve } from './reserve';

const Icon = objectIcon('application');
const usable = (data: Parameters<typeof canStore>[0]) => canStore(data) && usableReserve(data);

/** What an application consists of, the memory it may take, its last build, and the controller it is logged in to. */
export default function ApplicationEditor({ panelId, projectId, objectId }: EditorProps) {
  const t = useText();
  const draft = useDraft(panelId, projectId, objectId, ofKind('application'), usable);
  const { data: objects } = useObjects(projectId);
  const active = useProject((state) => state.applicationId) === objectId;
  const session = useOnline((state) => state.sessions[objectId]);
  const build = useMessages((state) => (state.build?.applicationId === objectId ? state.build : null));
  const counts = useMemo(() => {
    const counted: Record<ContentGroup, number> = {
      programs: 0,
      blocks: 0,
      functions: 0,
      types: 0,
      lists: 0,
      tasks: 0,
    };
    for (const { kind, subkind } of objects ? subtree(forestOf(objects), objectId).slice(1) : []) {
      const group = kindOf(kind)?.countedAs?.(subkind);
      if (group !== undefined) counted[group]++;
    }
    return counted;
  }, [objects, objectId]);
  const messages = countOf(build?.report.diagnostics ?? []);
  return (
    <FormPage draft={draft}>
      {(application) => (
        <>
          <h1 className={styles.title}>
            <Icon size={20} />
            {draft.object?.name}
          </h1>
          <div className={styles.tools}>
            {!active && (
              <Button icon={CircleCheckBig} onClick={() => setActiveApplication(objectId)}>
                {t('command.setActive')}
              </Button>
            )}
            <Button
              icon={Hammer}
              disabledReason={active ? null : t('application.notActive')}
              onClick={() => void runCommand('build.build')}
            >
              {t('command.build')}
            </Button>
            <Button
              icon={LogIn}
              disabledReason={active ? (session ? t('reason.loggedIn') : null) : t('application.notActive')}
              onClick={() => void runCommand('online.login')}
            >
              {t('command.login')}
            </Button>
          </div>
          <Section title={t('application.contents')}>
            <Facts>
              {Object.entries(counts).map(([what, count]) => (
                <div key={what} style={{ display: 'contents' }}>
                  <dt>{t(`application.${what as keyof typeof counts}`)}</dt>
                  <dd className="digits">{count}</dd>
                </div>
              ))}
            </Facts>
          </Section>
          <HeapFields
            application={application}
            disabled={draft.readOnly !== null}
            onChange={(heap) => draft.change({ ...application, heap })}
          />
          <ReserveFields
            application={application}
            disabled={draft.readOnly !== null}
            onChange={(change_reserve) => draft.change({ ...application, change_reserve })}
          />
          <SourceFields
            value={application.source_download}
            disabled={draft.readOnly !== null}
            onChange={(source_download) => draft.change({ ...application, source_download })}
          />
          <Section title={t('application.build')}>
            {build ? (
              <Facts>
                <dt>{t('application.result')}</dt>
                <dd>{`${t('messages.error', { count: messages.error })}, ${t('messages.warning', { count: messages.warning })}`}</dd>
                <dt>{t('application.code')}</dt>
                <dd>{build.report.code_size === null ? '–' : bytesText(build.report.code_size)}</dd>
                <dt>{t('application.data')}</dt>
                <dd>{build.report.data_size === null ? '–' : bytesText(build.report.data_size)}</dd>
                <dt>{t('application.codeId')}</dt>
                <dd className="code">{build.report.code_id?.slice(0, 16) ?? '–'}</dd>
              </Facts>
            ) : (
              <p className={styles.note}>{t('application.notBuilt')}</p>
            )}
          </Section>
          <Section title={t('application.controller')}>
            {session?.runtime ? (
              <Facts>
                <dt>{t('runtime.name')}</dt>
                <dd>{session.runtime.name}</dd>
                <dt>{t('tasks.status')}</dt>
                <dd>{runtimeText(session.runtime, t)}</dd>
                <dt>{t('application.relation')}</dt>
                <dd>{t(`relation.${session.relation}`)}</dd>
                {session.runtime.scheduling && (
                  <>
                    <dt>{t('application.scheduling')}</dt>
                    <dd>{session.runtime.scheduling}</dd>
                  </>
                )}
              </Facts>
            ) : (
              <p className={styles.note}>{t('status.offline')}</p>
            )}
          </Section>
        </>
      )}
    </FormPage>
  );
}
