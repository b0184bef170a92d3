// @vitest-environment happy-dom
import { useEffect } from 'react';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { clear, reads, show } from '../../tests/page';
import { DialogHost, openDialog } from './dialogs';
import { useNotices } from './notices';

beforeEach(() => {
  vi.spyOn(console, 'error').mockImplementation(() => undefined);
});
afterEach(() => {
  vi.restoreAllMocks();
  clear();
  useNotices.setState({ notices: [] });
});

function Failing(): never {
  throw new Error('no such table');
}

function FailingWhenClosed({ close }: { close: (answer: string) => void }) {
  useEffect(
    () => () => {
      throw new Error('already gone');
    },
    [],
  );
  return (
    <button type="button" onClick={() => close('taken')}>
      take
    </button>
  );
}

const page = (rest: string) => (
  <>
    <p>{rest}</p>
    <DialogHost />
  </>
);

it('tells a dialog that fails, cancels it, and leaves the page', async () => {
  const shown = show(page('workbench'));
  await reads(shown, 'workbench');
  expect(await openDialog(() => <Failing />)).toBeUndefined();
  expect(useNotices.getState().notices.map((notice) => notice.text)).toEqual(['no such table']);
  void openDialog(() => <b>next</b>);
  await reads(shown, 'next');
  await reads(shown, 'workbench');
});

it('takes the answer of a dialog that fails when it closes', async () => {
  const shown = show(page('workbench'));
  const answer = openDialog<string>((close) => <FailingWhenClosed close={close} />);
  const read = await reads(shown, 'take');
  read.querySelector('button')!.click();
  expect(await answer).toBe('taken');
  await vi.waitFor(() => {
    expect(useNotices.getState().notices.map((notice) => notice.text)).toEqual(['already gone']);
  });
  await reads(shown, 'workbench');
});
