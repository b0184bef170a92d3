/** A cam in the application that runs: what it has, which blocks follow it, and where they are (CAM-94). */
import { useQuery } from '@tanstack/react-query';
import { useCallback, useEffect, useMemo, useState, useSyncExternalStore } from 'react';
import { api } from '@/api/client';
import type { Schemas } from '@/api/types';
import { t } from '@/i18n';
import { channelOf } from '@/online/connections';
import { useSymbols, useWatched } from '@/online/useLive';
import { notify, notifyError } from '@/ui/notices';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { CamTable } from './camTable';
import type { CamEdit } from './edit';

const BLOCK = 'MC_CamIn';
const LOOK_MS = 2000;

const variable = (name: string) => `IoConfig_${name}.${name}`;
const cam = (path: string) => `${path}.fbCoupling.fbCam`;
/** Variables of a block that follows a cam. */
export const followed = {
  cam: (path: string) => `${cam(path)}.stUse.stCam.pCT`,
  active: (path: string) => `${path}.Active`,
  inSync: (path: string) => `${path}.InSync`,
  master: (path: string) => `${cam(path)}.fX`,
  slave: (path: string) => `${cam(path)}.fY`,
  scaling: (path: string) => `${cam(path)}.stUse.fSlaveScaling`,
} as const;
const MEMBERS = Object.values(followed);
const NONE: readonly string[] = [];

/** Paths of the blocks that have an axis follow the cam now, in order of the application. */
export function useFollowers(session: OnlineSession | null, name: string): readonly string[] {
  const runtimeId = session?.runtimeId ?? null;
  const tree = useSymbols(session);
  const [blocks, setBlocks] = useState<readonly string[]>(NONE);
  useEffect(() => {
    let current = true;
    const found = tree?.instancesOf(BLOCK) ?? Promise.resolve(NONE);
    found.then((paths) => current && setBlocks(paths)).catch(() => current && setBlocks(NONE));
    return () => {
      current = false;
    };
  }, [tree]);
  const known = runtimeId === null ? NONE : blocks;
  const path = variable(name);
  const elements = `${path}.pce`;
  const places = useMemo(() => [elements, path, `${path}_A`], [elements, path]);
  useWatched(
    runtimeId,
    useMemo(() => [...places, ...known.flatMap((path) => MEMBERS.map((of) => of(path)))], [places, known]),
  );
  const board = channelOf(runtimeId)?.board ?? null;
  const looked = useMemo(
    () => [...known.map(followed.cam), ...known.map(followed.active), elements],
    [known, elements],
  );
  const subscribe = useCallback(
    (listener: () => void) => {
      const stops = looked.map((expression) => board?.subscribe(expression, listener));
      return () => stops.forEach((stop) => stop?.());
    },
    [board, looked],
  );
  const lines = useSyncExternalStore(subscribe, () => {
    const address = board?.get(elements)?.value;
    const [, itself, array] = places.map((one) => board?.get(one)?.item.place);
    if (typeof address !== 'bigint' || !itself || !array) return '';
    // pce is the address of the elements; variables of the application lie in one piece of memory.
    const own = address + BigInt(itself.offset - array.offset);
    return known
      .filter(
        (path) => board?.get(followed.cam(path))?.value === own && board.get(followed.active(path))?.value === true,
      )
      .join('\n');
  });
  return useMemo(() => (lines === '' ? NONE : lines.split('\n')), [lines]);
}

/** Whether the application has the cam of the editor; without an answer as long as that is not known. */
export function useRunningCam(session: OnlineSession, name: string, shown: CamTable) {
  const { runtimeId } = session;
  return useQuery({
    queryKey: ['running-cam', runtimeId, session.runtime?.code_id ?? null, name, shown],
    queryFn: () => readCam(runtimeId, name, shown),
    enabled: session.lostSince === null,
    refetchInterval: LOOK_MS,
    retry: false,
    gcTime: 0,
  });
}

function readCam(runtime_id: string, name: string, shown: CamTable): Promise<Schemas['RunningCamAnswer']> {
  return api.post('/api/v1/runtimes/{runtime_id}/cams/{name}/read', {
    params: { path: { runtime_id, name } },
    body: { cam: shown },
  });
}

/** Takes the curve and the tappets of the application into the editor: a step that can be undone. */
export async function readRunning(runtimeId: string, name: string, edit: CamEdit): Promise<void> {
  try {
    const found = await readCam(runtimeId, name, edit.cam);
    if (!found.same) edit.change(found.cam, null);
    notify({ tone: 'ok', title: t(found.same ? 'cam.readSame' : 'cam.readDone', { name }) });
  } catch (error) {
    notifyError(error);
  }
}

export function writeRunning(runtime_id: string, name: string, written: CamTable): Promise<unknown> {
  return api.post('/api/v1/runtimes/{runtime_id}/cams/{name}/write', {
    params: { path: { runtime_id, name } },
    body: { cam: written },
  });
}
