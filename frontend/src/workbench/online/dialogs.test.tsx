// @vitest-environment happy-dom
import { flushSync } from 'react-dom';
import { afterEach, describe, expect, it } from 'vitest';
import { clear, reads, show } from '../../../tests/page';
import type { LoginAnswer, RuntimeState } from '@/api/types';
import { DialogHost } from '@/ui/dialogs';
import { askDownload, askLogin } from './dialogs';
import { loginChoices, proposedChoice } from './loginChoices';

afterEach(() => {
  [...document.querySelectorAll('button')].find(({ textContent }) => textContent === 'Cancel')?.click();
  clear();
});

const machine = (state: RuntimeState['state']) =>
  ({ name: 'Filler PLC', application: 'Application', state }) as unknown as RuntimeState;
const found = (relation: LoginAnswer['relation'], loaded_project: string | null = null): LoginAnswer => ({
  relation,
  reasons: [],
  persistent: [],
  retain_layout_changes: false,
  changes: [],
  changes_omitted: 0,
  reserve: null,
  loaded_project,
});
const names = { application: 'Application', project: 'Line 2' };
const focused = () => document.activeElement?.textContent;

describe('what a login proposes', () => {
  it.each([
    ['online_change', true, 'online_change'],
    ['download', true, 'without'],
    ['download', false, 'download'],
    ['foreign', true, null],
    ['foreign', false, 'download'],
    ['empty', false, 'download'],
  ] as const)('%s, running %s: %s', (relation, running, proposed) => {
    expect(proposedChoice(loginChoices(relation, true), running)).toBe(proposed);
  });

  it('is only to look for those who may not load', () => {
    expect(loginChoices('online_change', false)).toEqual(['without']);
  });
});

describe('the question of a login', () => {
  it('names both projects, and Enter does not stop a running machine', async () => {
    const page = show(<DialogHost />);
    void askLogin({ answer: found('foreign', 'Line 1'), ...names, runtime: machine('run'), mayLoad: true });
    await reads(page, "'Filler PLC' holds 'Application' of project 'Line 1'");
    await reads(page, "Replace it by 'Application' of project 'Line 2'?");
    expect(focused()).toBe('Cancel');
  });

  it('proposes to look at the older program of a running machine', async () => {
    const page = show(<DialogHost />);
    void askLogin({ answer: found('download'), ...names, runtime: machine('run'), mayLoad: true });
    await reads(page, "an older 'Application' of project 'Line 2'");
    expect(page.querySelector('[role="radio"][aria-checked="true"]')?.textContent).toContain('without any change');
    expect(focused()).toBe('Login without change');
  });
});

describe('the question of a download', () => {
  it.each([
    [true, 'Cancel'],
    [false, 'Download'],
  ])('while the machine runs (%s) has its focus on %s', async (running, button) => {
    const page = show(<DialogHost />);
    void askDownload({ ...names, running, persistent: [] });
    await reads(page, "'Application' of project 'Line 2'");
    expect(focused()).toBe(button);
  });

  it('says which persistent variables lose their values, and lets the others begin anew', async () => {
    const page = show(<DialogHost />);
    const asked = askDownload({
      ...names,
      running: true,
      persistent: [{ path: 'Kept.nParts', reason: 'type_changed' }],
    });
    await reads(page, 'Kept.nParts · has another type');
    const box = page.querySelectorAll<HTMLElement>('[role="checkbox"]')[0]!;
    flushSync(() => box.click());
    [...page.querySelectorAll('button')].find(({ textContent }) => textContent === 'Download')!.click();
    expect(await asked).toEqual({ start: true, fresh: true });
  });
});
