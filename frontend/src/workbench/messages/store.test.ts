import { describe, expect, it } from 'vitest';
import type { Diagnostic } from '@/api/types';
import {
  bytesText,
  buildFinished,
  clearMessages,
  countOf,
  hasPlace,
  isMended,
  pathParts,
  presentMessages,
  publishDiagnostics,
  translateMessages,
  useMessages,
  type BuildResult,
} from './store';

const message = (object_id: string | null, severity: Diagnostic['severity'], text = 'm'): Diagnostic => ({
  code: 'E0001',
  severity,
  message: text,
  advice: null,
  object_id,
  object_path: '',
  part: null,
  element: null,
  line: null,
  column: null,
  end_line: null,
  end_column: null,
});
const build = (...diagnostics: Diagnostic[]): BuildResult => ({
  applicationId: 'a',
  applicationName: 'A',
  at: 0,
  report: { ok: false, diagnostics, code_id: null, data_id: null, code_size: null, data_size: null, seconds: 1 },
});

describe('messages', () => {
  it('of an object that its editor has checked since are the newer ones', () => {
    const shown = presentMessages(
      build(message('x', 'error', 'old'), message('y', 'warning')),
      new Map([['x', [message('x', 'info', 'new')]]]),
    );
    expect(shown.map((one) => one.message)).toEqual(['m', 'new']);
  });

  it('come in another language from where they came, and those of open texts from their editors', async () => {
    const again = () => Promise.resolve(build(message('x', 'error', '错误')).report);
    buildFinished({ ...build(message('x', 'error', 'fault')), again });
    publishDiagnostics('y', [message('y', 'warning', 'old')]);
    await translateMessages();
    const { build: now, live } = useMessages.getState();
    expect(presentMessages(now, live).map((one) => one.message)).toEqual(['错误']);
  });

  it('of a build that has been replaced meanwhile are not translated', async () => {
    const late = build(message('x', 'error', '晚'));
    buildFinished({
      ...build(message('x', 'error', 'fault')),
      again: () => {
        buildFinished(build(message('x', 'error', 'new')));
        return Promise.resolve(late.report);
      },
    });
    await translateMessages();
    expect(useMessages.getState().build?.report.diagnostics.map((one) => one.message)).toEqual(['new']);
  });

  it('without an object stay until the next build', () => {
    expect(presentMessages(build(message(null, 'error')), new Map([['x', []]]))).toHaveLength(1);
  });

  it('are taken away without forgetting that the application was built', () => {
    buildFinished(build(message('x', 'warning')));
    clearMessages();
    expect(useMessages.getState().build?.applicationName).toBe('A');
    expect(presentMessages(useMessages.getState().build, new Map())).toEqual([]);
  });

  it('of a failed build hold no more once editors have found its errors gone', () => {
    const failed = build(message('x', 'error'), message('y', 'warning'));
    expect(isMended(failed, new Map())).toBe(false);
    expect(isMended(failed, new Map([['x', [message('x', 'warning')]]]))).toBe(true);
    expect(isMended({ ...failed, report: { ...failed.report, ok: true } }, new Map([['x', []]]))).toBe(false);
    expect(isMended(null, new Map())).toBe(false);
  });

  it('have a place, except those of the application and the lines of {text} pragmas', () => {
    const text = { ...message('x', 'info'), code: 'W1212' };
    expect([message('x', 'info'), message(null, 'info'), text].map(hasPlace)).toEqual([true, false, false]);
  });

  it('are counted by severity', () => {
    expect(countOf([message('x', 'error'), message('x', 'error'), message('y', 'info')])).toEqual({
      error: 2,
      warning: 0,
      info: 1,
    });
  });
});

describe('paths', () => {
  it('name the object first', () => {
    expect(pathParts('Device/App/FB')).toEqual({ name: 'FB', place: 'Device: App' });
    expect(pathParts('FB')).toEqual({ name: 'FB', place: '' });
  });
});

describe('sizes', () => {
  it('are short', () => {
    expect([0, 999, 38_400, 123_456, 2_100_000].map(bytesText)).toEqual([
      '0 B',
      '999 B',
      '38.4 KB',
      '123 KB',
      '2.1 MB',
    ]);
  });
});
