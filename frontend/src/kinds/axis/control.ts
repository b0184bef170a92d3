/** Control of an axis from a page: taken explicitly, kept by a beat that the PLC waits for, given back when the page goes. */
import { useCallback, useEffect, useRef, useState } from 'react';
import { api } from '@/api/client';
import type { Schemas } from '@/api/types';
import { notifyError } from '@/ui/notices';

/** Well below the patience of the panel in the PLC (`AxisPanel.fPatience`). */
const BEAT_MS = 300;
const TAKING_MS = 1500;
const LOOK_MS = 80;

export type SteerAction = 'power_on' | 'power_off' | 'jog_forward' | 'jog_backward' | 'jog_end' | MotionAction;
export type MotionAction = 'move_absolute' | 'move_relative' | 'set_position' | 'home' | 'reset';
type Status = Schemas['PanelStatus'];

export interface Motion {
  position: number;
  velocity: number;
  acceleration: number;
  deceleration: number;
  jerk: number;
}

export interface AxisControl {
  /** The number of this page. */
  holder: number;
  /** This page moves the axis. */
  mine: boolean;
  /** Control was lost although the page is there. */
  lost: boolean;
  /** Resolves to whether the axis was taken; false: the program moves it, so control has to be forced. */
  take: (force: boolean) => Promise<boolean>;
  steer: (action: SteerAction, motion?: Motion) => void;
  stop: () => void;
  release: () => void;
}

function newHolder(): number {
  return (crypto.getRandomValues(new Uint32Array(1))[0] ?? 0) || 1;
}

const pause = (ms: number) => new Promise((done) => setTimeout(done, ms));

export function useAxisControl(runtime_id: string, axis: string): AxisControl {
  const [holder] = useState(newHolder);
  const [mine, setMine] = useState(false);
  const [lost, setLost] = useState(false);
  const queue = useRef<Promise<unknown>>(Promise.resolve());

  /** Requests keep their order: the end of a jog must not overtake its beginning. */
  const inOrder = useCallback(<Answer>(request: () => Promise<Answer>): Promise<Answer> => {
    const answer = queue.current.then(request, request);
    queue.current = answer.catch(() => undefined);
    return answer;
  }, []);
  const keep = useCallback(
    (): Promise<Status> =>
      api.post('/api/v1/runtimes/{runtime_id}/axes/{axis}/panel/alive', {
        params: { path: { runtime_id, axis } },
        body: { holder },
      }),
    [runtime_id, axis, holder],
  );
  const halt = useCallback(
    (release: boolean, keepalive = false) =>
      api.post('/api/v1/runtimes/{runtime_id}/axes/{axis}/panel/stop', {
        params: { path: { runtime_id, axis } },
        body: { holder, release },
        keepalive,
      }),
    [runtime_id, axis, holder],
  );
  const send = useCallback(
    (action: SteerAction | 'take' | 'force', motion?: Motion) =>
      api.post('/api/v1/runtimes/{runtime_id}/axes/{axis}/panel', {
        params: { path: { runtime_id, axis } },
        body: { holder, action, ...motion },
      }),
    [runtime_id, axis, holder],
  );
  const holds = useCallback((status: Status) => status.holder === holder && status.state !== 'Free', [holder]);

  const take = useCallback(
    async (force: boolean) => {
      await inOrder(() => send(force ? 'force' : 'take'));
      for (let waited = 0; waited < TAKING_MS; waited += LOOK_MS) {
        if (holds(await keep())) {
          setLost(false);
          setMine(true);
          return true;
        }
        await pause(LOOK_MS);
      }
      return false;
    },
    [inOrder, send, keep, holds],
  );

  useEffect(() => {
    if (!mine) return;
    let present = true;
    const beat = setInterval(() => {
      keep().then(
        (status) => {
          if (!present || holds(status)) return;
          setMine(false);
          setLost(true);
        },
        () => undefined, // The PLC stops the axis when this lasts.
      );
    }, BEAT_MS);
    const leave = () => void halt(true, true).catch(() => undefined);
    window.addEventListener('pagehide', leave);
    return () => {
      present = false;
      clearInterval(beat);
      window.removeEventListener('pagehide', leave);
      leave();
    };
  }, [mine, keep, halt, holds]);

  const steer = useCallback(
    (action: SteerAction, motion?: Motion) => void inOrder(() => send(action, motion)).catch(notifyError),
    [inOrder, send],
  );
  const stop = useCallback(() => void halt(false).catch(notifyError), [halt]);
  const release = useCallback(() => setMine(false), []);
  return { holder, mine, lost, take, steer, stop, release };
}
