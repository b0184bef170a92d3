import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { api } from '@/api/client';
import type { LoginAnswer, RuntimeVersion } from '@/api/types';
import { useText } from '@/i18n';
import { Empty, Loading } from '@/ui/Empty';
import { FormDialog } from '@/ui/FormDialog';
import { Table } from '@/ui/Table';
import type { Column } from '@/ui/table';
import { secondText } from '../clock';
import { ChangesTable } from './ChangesTable';
import styles from './dialogs.module.css';
import { DownloadTerms, type DownloadChoice } from './DownloadTerms';

export interface RestoreChoice extends DownloadChoice {
  codeId: string;
  mode: 'online_change' | 'download';
}

interface VersionsDialogProps {
  projectId: string;
  applicationId: string;
  runtimeId: string;
  versions: readonly RuntimeVersion[];
  /** The controller runs: a download would stop it. */
  running: boolean;
  close: (choice?: RestoreChoice) => void;
}

const keyOf = ({ at, code_id }: RuntimeVersion) => `${at} ${code_id}`;

/** Who brought which version into the controller, what going back to one costs, and going back. */
export function VersionsDialog({ projectId, applicationId, runtimeId, versions, running, close }: VersionsDialogProps) {
  const t = useText();
  const [version, setVersion] = useState(() => versions.find(({ runs, kept }) => !runs && kept) ?? null);
  const [choice, setChoice] = useState<DownloadChoice>({ start: running, fresh: false });
  const possible = version !== null && version.kept && !version.runs;
  const codeId = version?.code_id ?? '';
  const costs = useQuery({
    queryKey: ['projects', projectId, 'versions', applicationId, runtimeId, codeId],
    queryFn: () =>
      api.post('/api/v1/projects/{project_id}/applications/{application_id}/versions/{code_id}/compare', {
        params: { path: { project_id: projectId, application_id: applicationId, code_id: codeId } },
        body: { runtime_id: runtimeId },
      }),
    enabled: possible,
    gcTime: 0,
    retry: false,
  });
  const online = costs.data?.relation === 'online_change';
  const same = costs.data?.relation === 'same';
  const stops = costs.data !== undefined && !online && !same;
  const columns: Column<RuntimeVersion>[] = [
    { id: 'at', title: t('versions.at'), width: 150, cell: ({ at }) => secondText(at), sort: ({ at }) => at },
    { id: 'who', title: t('versions.who'), width: 110, grow: true, cell: ({ username }) => username },
    { id: 'how', title: t('versions.how'), width: 120, cell: ({ how }) => t(`versions.how.${how}`) },
    { id: 'code', title: t('versions.code'), width: 110, cell: ({ code_id }) => code_id.slice(0, 8) },
    {
      id: 'state',
      title: t('versions.state'),
      width: 170,
      cell: ({ runs, kept }) => (runs ? t('versions.runs') : kept ? '' : t('versions.notKept')),
    },
  ];
  const refused = () => {
    if (version === null) return t('versions.choose');
    if (version.runs || same) return t('versions.runsAlready');
    if (!version.kept) return t('versions.notKeptText');
    return costs.data === undefined ? t('versions.asking') : null;
  };
  return (
    <FormDialog
      title={t('versions.title')}
      description={t('versions.text')}
      width={860}
      onClose={() => close()}
      onSubmit={() => close({ codeId, mode: online ? 'online_change' : 'download', ...choice })}
      action={t(online || costs.data === undefined ? 'versions.back' : 'versions.download')}
      danger={stops && running}
      disabledReason={refused()}
      focusCancel={running}
    >
      <div className={styles.versions}>
        <Table
          label={t('versions.title')}
          items={versions}
          columns={columns}
          keyOf={keyOf}
          selected={version && keyOf(version)}
          onSelect={(next) => {
            setVersion(next);
            setChoice((before) => ({ ...before, fresh: false })); // asked for the variables of another version
          }}
          empty={<Empty title={t('versions.none')} />}
        />
      </div>
      {possible && (
        <div className={styles.changes}>
          {costs.isPending ? (
            <Loading />
          ) : costs.error ? (
            <Empty title={t('versions.unknown')} text={costs.error.message} />
          ) : (
            <Costs answer={costs.data} close={() => close()} />
          )}
        </div>
      )}
      {possible && stops && (
        <DownloadTerms running={running} persistent={costs.data.persistent} choice={choice} onChoice={setChoice} />
      )}
    </FormDialog>
  );
}

function Costs({ answer, close }: { answer: LoginAnswer; close: () => void }) {
  const t = useText();
  if (answer.changes.length > 0) return <ChangesTable answer={answer} onLeave={close} />;
  if (answer.relation === 'same') return <Empty title={t('versions.runsAlready')} />;
  if (answer.relation === 'online_change') return <Empty title={t('versions.onlyCode')} />;
  return (
    <ul className={styles.why}>
      {answer.reasons.map((reason) => (
        <li key={reason}>{reason}</li>
      ))}
    </ul>
  );
}
