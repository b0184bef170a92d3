// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { setLanguage } from '@/i18n';
import { clear, reads, show } from '../../../tests/page';
import type { PastMoment } from '../onlineSession';
import CallStackPanel from './CallStackPanel';

const shown = vi.hoisted(() => ({ session: {}, looked: null as object | null }));
vi.mock('./session', () => ({ useActiveSession: () => shown.session }));
vi.mock('../debugger/useDebugged', () => ({ useDebugged: () => shown.looked }));
vi.mock('../debugger/HaltedStack', () => ({ HaltedStack: () => <p>halted stack</p> }));

const exception = {
  code: 1,
  name: 'DIV_ZERO',
  message: 'division by zero',
  task: 'Main',
  pou: 'Share',
  line: 3,
  cycle: 50,
  call_stack: [{ pou: 'Share', uri: '', line: 3, place: null }],
  values: {},
};
const past = (before: number, fault = true): PastMoment => ({ cycle: 50 - before / 10, at: 0, before, fault });

function panel(session: object, looked: object | null = null) {
  Object.assign(shown, { session: { runtimeId: 'r', runtime: {}, past: null, ...session }, looked });
  return show(<CallStackPanel />);
}

describe('the call stack', () => {
  beforeEach(() => setLanguage('en'));

  afterEach(clear);

  it('of an exception belongs to the present', async () => {
    const page = await reads(panel({ runtime: { exception } }), 'Share');
    expect(page.textContent).not.toContain('No call stack');
  });

  it('of an exception is shown in the past cycle that failed', async () => {
    const page = await reads(panel({ runtime: { exception }, past: past(0) }), 'Share');
    expect(page.textContent).not.toContain('No call stack');
  });

  it.each([past(20), past(0, false)])('of an exception is none of another cycle', async (moment) => {
    await reads(panel({ runtime: { exception }, past: moment }), `No call stack of cycle ${moment.cycle}`);
  });

  it('of a halted task is that of now, never beside past values', async () => {
    const looked = { runtimeId: 'r', debugged: { state: { halted: [{}] } } };
    await reads(panel({}, looked), 'halted stack');
    clear();
    const then = await reads(panel({ past: past(20, false) }, looked), 'No call stack of cycle 48');
    expect(then.textContent).not.toContain('halted stack');
  });

  it('says so in Chinese', async () => {
    await setLanguage('zh');
    await reads(panel({ runtime: { exception }, past: past(20) }), '周期 48 没有调用堆栈');
  });
});
