// @vitest-environment happy-dom
import { act, useEffect } from 'react';
import { createRoot, type Root } from 'react-dom/client';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { useAxisControl, type AxisControl } from './control';

/** The panel in the PLC, as far as pages see it. */
const panel = { state: 'Free', holder: 0, refuses: false };
const asked: string[] = [];

interface Asked {
  holder: number;
  action?: string;
  release?: boolean;
}

vi.mock('@/api/client', () => ({
  api: {
    post: (path: string, { body }: { body: Asked }) => {
      const name = path.split('/').at(-1) ?? '';
      asked.push(name === 'stop' && body.release ? 'release' : (body.action ?? name));
      if (body.release && body.holder === panel.holder) panel.state = 'Free';
      if (body.action === 'force' || (body.action === 'take' && !panel.refuses)) {
        panel.state = 'Control';
        panel.holder = body.holder;
      }
      return Promise.resolve({ state: panel.state, holder: panel.holder });
    },
  },
}));
vi.mock('@/ui/notices', () => ({ notifyError: vi.fn() }));

let control: AxisControl;
let root: Root;

function Probe() {
  const latest = useAxisControl('plc', 'Drive');
  useEffect(() => {
    control = latest;
  });
  return null;
}

const take = async (force = false) => {
  let taken = false;
  await act(async () => {
    const answer = control.take(force);
    await vi.advanceTimersByTimeAsync(3000);
    taken = await answer;
  });
  return taken;
};
const after = (ms: number) => act(async () => void (await vi.advanceTimersByTimeAsync(ms)));

beforeEach(() => {
  vi.useFakeTimers();
  Object.assign(panel, { state: 'Free', holder: 0, refuses: false });
  asked.length = 0;
  Object.assign(globalThis, { IS_REACT_ACT_ENVIRONMENT: true });
  root = createRoot(document.createElement('div'));
  act(() => root.render(<Probe />));
});
afterEach(() => {
  act(() => root.unmount());
  vi.useRealTimers();
});

describe('control of an axis', () => {
  it('is taken, kept by a beat and given back', async () => {
    expect(await take()).toBe(true);
    expect(control.mine).toBe(true);
    asked.length = 0;
    await after(900);
    expect(asked).toEqual(['alive', 'alive', 'alive']);
    await act(async () => {
      control.release();
      await Promise.resolve();
    });
    expect(control.mine).toBe(false);
    expect(asked.at(-1)).toBe('release');
    asked.length = 0;
    await after(2000);
    expect(asked).toEqual([]);
  });

  it('has to be forced where the program moves the axis', async () => {
    panel.refuses = true;
    expect(await take()).toBe(false);
    expect(control.mine).toBe(false);
    expect(await take(true)).toBe(true);
    expect(control.mine).toBe(true);
  });

  it('is lost when the PLC has taken it away', async () => {
    await take();
    panel.state = 'Free';
    await after(400);
    expect(control).toMatchObject({ mine: false, lost: true });
  });

  it('is given back when the page goes', async () => {
    await take();
    act(() => root.unmount());
    expect(asked.at(-1)).toBe('release');
    expect(panel.state).toBe('Free');
  });

  it('sends the end of a jog behind its beginning', async () => {
    await take();
    await act(async () => {
      asked.length = 0;
      control.steer('jog_forward');
      control.steer('jog_end');
      await vi.advanceTimersByTimeAsync(10);
    });
    expect(asked).toEqual(['jog_forward', 'jog_end']);
  });
});
