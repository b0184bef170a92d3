// @vitest-environment happy-dom
import { flushSync } from 'react-dom';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { clear, reads, show, until } from '../../../tests/page';
import { queryClient } from '@/api/queries';
import type { LoginAnswer, RuntimeVersion } from '@/api/types';
import { VersionsDialog, type RestoreChoice } from './VersionsDialog';

/** What going back costs, by the code of the version. */
const costs: Record<string, LoginAnswer> = {};

vi.mock('@/api/client', () => ({
  api: {
    post: (_: string, { params }: { params: { path: { code_id: string } } }) =>
      Promise.resolve(costs[params.path.code_id]),
  },
}));

beforeEach(() => {
  vi.spyOn(HTMLElement.prototype, 'clientHeight', 'get').mockReturnValue(300);
});
afterEach(() => {
  vi.restoreAllMocks();
  clear();
  queryClient.clear();
});

const version = (code_id: string, runs = false): RuntimeVersion => ({
  code_id,
  at: `2026-01-0${code_id.length}T10:00:00Z`,
  username: 'ada',
  how: 'download',
  runs,
  kept: true,
});
const cost = (relation: LoginAnswer['relation'], persistent: LoginAnswer['persistent'] = []): LoginAnswer => ({
  relation,
  reasons: [`It is the ${relation} of a test.`],
  persistent,
  retain_layout_changes: false,
  changes: [],
  changes_omitted: 0,
  reserve: null,
  loaded_project: null,
});

function open(running: boolean): { page: HTMLElement; choice: Promise<RestoreChoice | undefined> } {
  let answer: (choice?: RestoreChoice) => void = () => undefined;
  const choice = new Promise<RestoreChoice | undefined>((resolve) => (answer = resolve));
  const versions = [version('now', true), version('before'), version('first')];
  const page = show(
    <VersionsDialog
      projectId="p"
      applicationId="a"
      runtimeId="r"
      versions={versions}
      running={running}
      close={answer}
    />,
  );
  return { page, choice };
}

const boxes = (page: HTMLElement) => [...page.querySelectorAll<HTMLElement>('[role="checkbox"]')];
const press = (page: HTMLElement, text: string) =>
  flushSync(() => [...page.querySelectorAll('button')].find(({ textContent }) => textContent === text)!.click());

describe('back to a version by a download', () => {
  it('says which persistent variables lose their values, and lets the others begin anew', async () => {
    costs.before = cost('download', [{ path: 'Kept.nParts', reason: 'removed' }]);
    const { page, choice } = open(true);
    await reads(page, 'Kept.nParts');
    await reads(page, 'stops');
    flushSync(() => boxes(page)[0]!.click());
    press(page, 'Go back by download');
    expect(await choice).toEqual({ codeId: 'before', mode: 'download', start: true, fresh: true });
  });

  it('starts the machine afterwards as it is asked to', async () => {
    costs.before = cost('download');
    const { page, choice } = open(true);
    await reads(page, 'download of a test');
    expect(page.querySelector('[role="group"][aria-label="Persistent variables"]')).toBeNull();
    flushSync(() => boxes(page)[0]!.click());
    press(page, 'Go back by download');
    expect(await choice).toEqual({ codeId: 'before', mode: 'download', start: false, fresh: false });
  });

  it('does not let them begin anew for another version than the one that was asked about', async () => {
    costs.before = cost('download', [{ path: 'Kept.nParts', reason: 'removed' }]);
    costs.first = cost('download');
    const { page, choice } = open(false);
    await reads(page, 'Kept.nParts');
    flushSync(() => boxes(page)[0]!.click());
    const rows = [...page.querySelectorAll<HTMLElement>('[role="row"]')];
    flushSync(() =>
      rows
        .find(({ textContent }) => textContent.includes('first'))!
        .dispatchEvent(new MouseEvent('pointerdown', { bubbles: true })),
    );
    await until(page, ({ textContent }) => textContent.includes('of a test') && !textContent.includes('Kept.nParts'));
    press(page, 'Go back by download');
    expect(await choice).toEqual({ codeId: 'first', mode: 'download', start: false, fresh: false });
  });
});
