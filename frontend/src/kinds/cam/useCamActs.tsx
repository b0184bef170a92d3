import { useMemo, type RefObject } from 'react';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { Enablement, Handlers } from '@/workbench/commands';
import { openDialog } from '@/ui/dialogs';
import { CAM_ACTS, type CamActId } from './acts';
import { CodeDialog } from './CodeDialog';
import type { CamEdit } from './edit';
import { ExportDialog } from './ExportDialog';
import { ImportDialog } from './ImportDialog';
import { OptimiseDialog } from './OptimiseDialog';
import { readRunning } from './runningCam';
import { WriteDialog } from './WriteDialog';

export interface CamScene {
  projectId: string;
  name: string;
  edit: CamEdit;
  session: OnlineSession | null;
}

const RUN: Readonly<Record<CamActId, (scene: CamScene) => void>> = {
  'cam.import': ({ projectId, edit }) =>
    void openDialog((close) => <ImportDialog projectId={projectId} edit={edit} close={close} />),
  'cam.export': ({ projectId, name, edit }) =>
    void openDialog((close) => <ExportDialog projectId={projectId} name={name} cam={edit.cam} close={close} />),
  'cam.optimise': ({ projectId, edit }) =>
    void openDialog((close) => <OptimiseDialog projectId={projectId} edit={edit} close={close} />),
  'cam.code': ({ projectId, name, edit }) =>
    void openDialog((close) => <CodeDialog projectId={projectId} name={name} cam={edit.cam} close={close} />),
  'cam.readRunning': ({ session, name, edit }) => session && void readRunning(session.runtimeId, name, edit),
  'cam.writeRunning': ({ projectId, name, edit, session }) =>
    session &&
    void openDialog((close) => (
      <WriteDialog projectId={projectId} name={name} cam={edit.cam} session={session} close={close} />
    )),
};

/** The acts of the cam that is shown, as commands find them: the same object until what is possible changes. */
export function useCamActs(latest: RefObject<CamScene | null>, online: boolean, allowed: Enablement): Handlers {
  return useMemo(() => {
    const possible = { editing: allowed, application: online ? true : 'reason.notLoggedIn' } as const;
    return Object.fromEntries(
      CAM_ACTS.map(({ id, needs }) => {
        const run = () => {
          if (latest.current) RUN[id](latest.current);
        };
        return [id, { run, enabled: needs.map((need) => possible[need]).find((one) => one !== true) ?? true }];
      }),
    );
  }, [latest, allowed, online]);
}
