import { describe, expect, it } from 'vitest';
import type { RuntimeException, RuntimeState } from '@/api/types';
import { useProject } from '@/project/openProject';
import { useNotices } from '@/ui/notices';
import { useOnline, type OnlineSession } from '../onlineSession';
import { exceptionPlace, exceptionText, exceptionTitle, followExceptions, newExceptions } from './exception';

const exception = (name: string, line: number | null = 2): RuntimeException => ({
  name,
  line,
  code: 1,
  message: 'as the runtime says it',
  task: 'MainTask',
  pou: 'PLC_PRG',
  uri: 'PLC_PRG',
  object_id: null,
  part: 'implementation',
  element: null,
  call_stack: [],
  values: {},
});

const session = (applicationId: string, raised: RuntimeException | null): OnlineSession => ({
  applicationId,
  runtimeId: 'local',
  relation: 'same',
  runtime: { exception: raised } as RuntimeState,
  lostSince: null,
  pacedMs: null,
  past: null,
});

describe('exceptions', () => {
  it('are described by their kind, unknown ones in the words of the runtime', () => {
    expect(exceptionTitle(exception('DIV_ZERO'))).toBe('Division by zero');
    expect(exceptionTitle(exception('USER'))).toBe('as the runtime says it');
  });

  it('name the place as far as it is known', () => {
    expect(exceptionPlace(exception('DIV_ZERO'))).toBe('PLC_PRG, line 2, task MainTask');
    expect(exceptionPlace(exception('DIV_ZERO', null))).toBe('PLC_PRG, task MainTask');
  });

  it('say what to do when the application waits to be started', () => {
    const ended = { ...exception('PROCESS_ENDED'), task: '', values: { signal: 'SIGSEGV' } };
    expect(exceptionText(ended)).toContain('SIGSEGV');
    expect(exceptionText(ended)).toContain('start it anyway');
    expect(exceptionPlace(ended)).toBe('PLC_PRG, line 2');
    expect(exceptionText(exception('DIV_ZERO'))).toBe('as the runtime says it');
    expect(exceptionText({ ...exception('DIV_ZERO'), message: 'division by zero' })).toBe('');
  });

  it('are new once: not at the next state, again after a reset', () => {
    const fine = { a: session('a', null), b: session('b', null) };
    const failed = { ...fine, a: session('a', exception('DIV_ZERO')) };
    expect(newExceptions(failed, fine).map((one) => one.applicationId)).toEqual(['a']);
    expect(newExceptions({ ...failed, a: session('a', exception('DIV_ZERO')) }, failed)).toEqual([]);
    expect(newExceptions(fine, failed)).toEqual([]);
    expect(newExceptions(failed, {}).map((one) => one.applicationId)).toEqual(['a']);
  });

  it('of the active application are no notice over its values', () => {
    useProject.setState({ applicationId: 'a' });
    useOnline.setState({ sessions: { a: session('a', null), b: session('b', null) } });
    const stop = followExceptions();
    useOnline.setState({ sessions: { a: session('a', exception('DIV_ZERO')), b: session('b', null) } });
    expect(useNotices.getState().notices).toEqual([]);
    useOnline.setState({
      sessions: { a: session('a', exception('DIV_ZERO')), b: session('b', exception('DIV_ZERO')) },
    });
    expect(useNotices.getState().notices.map(({ title }) => title)).toEqual(['Exception: Division by zero']);
    stop();
  });
});
