import { useQuery } from '@tanstack/react-query';
import { api } from '@/api/client';
import { useText } from '@/i18n';
import { numberText } from '@/editors/form/numbers';
import { useLiveNumber } from '@/online/useLive';
import { FormDialog } from '@/ui/FormDialog';
import { notify, notifyError } from '@/ui/notices';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { CamTable } from './camTable';
import styles from './Cam.module.css';
import { rounded } from './cells';
import { followed, useFollowers, writeRunning } from './runningCam';

const LOOK_MS = 300;

interface WriteDialogProps {
  projectId: string;
  name: string;
  cam: CamTable;
  session: OnlineSession;
  close: (answer?: true) => void;
}

/** Writes the cam that is shown to the application; says beforehand how far slaves would step. */
export function WriteDialog({ projectId, name, cam, session, close }: WriteDialogProps) {
  const t = useText();
  const followers = useFollowers(session, name);
  const write = async () => {
    try {
      await writeRunning(session.runtimeId, name, cam);
      notify({ tone: 'ok', title: t('cam.writeDone', { name }) });
      close(true);
    } catch (error) {
      notifyError(error);
    }
  };
  return (
    <FormDialog
      title={t('cam.writeRunning')}
      description={t('cam.writeText')}
      width={560}
      action={t('cam.write')}
      danger={followers.length > 0}
      focusCancel={followers.length > 0}
      focusAction={followers.length === 0}
      onClose={() => close()}
      onSubmit={() => void write()}
    >
      {followers.length === 0 ? (
        <p>{t('cam.noFollowers')}</p>
      ) : (
        <table className={styles.steps}>
          <thead>
            <tr>
              <th>{t('cam.step.block')}</th>
              <th>{t('cam.master')}</th>
              <th>{t('cam.step.now')}</th>
              <th>{t('cam.step.then')}</th>
              <th>{t('cam.step.step')}</th>
            </tr>
          </thead>
          <tbody>
            {followers.map((path) => (
              <Step key={path} projectId={projectId} cam={cam} runtimeId={session.runtimeId} path={path} />
            ))}
          </tbody>
        </table>
      )}
    </FormDialog>
  );
}

interface StepProps {
  projectId: string;
  cam: CamTable;
  runtimeId: string;
  path: string;
}

function Step({ projectId, cam, runtimeId, path }: StepProps) {
  const x = useLiveNumber(runtimeId, followed.master(path));
  const y = useLiveNumber(runtimeId, followed.slave(path));
  const scaling = useLiveNumber(runtimeId, followed.scaling(path));
  const { data } = useQuery({
    queryKey: ['cam-step', projectId, path, cam],
    queryFn: async () => {
      const { at } = await api.post('/api/v1/projects/{project_id}/cams/curves', {
        params: { path: { project_id: projectId } },
        body: { cam, samples: 2, at: [x!] },
      });
      return { before: { x, y }, after: at[0]!.y };
    },
    enabled: x !== null && y !== null,
    refetchInterval: LOOK_MS,
    gcTime: 0,
  });
  const step = data && scaling !== null ? (data.after - data.before.y!) * scaling : null;
  return (
    <tr>
      <th className="code">{path}</th>
      <td className="digits">{shown(data?.before.x)}</td>
      <td className="digits">{shown(data?.before.y)}</td>
      <td className="digits">{shown(data?.after)}</td>
      <td className="digits">{step === null ? '–' : `${shown(step)} u`}</td>
    </tr>
  );
}

const shown = (value: number | null | undefined) => (value == null ? '–' : numberText(rounded(value)));
