// @vitest-environment happy-dom
import { act, createElement, useEffect } from 'react';
import { createRoot, type Root } from 'react-dom/client';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { ofKind } from '@/api/objects';
import type { Schemas } from '@/api/types';
import { useSelection } from '@/workbench/selection';
import { useDraft, type Draft } from './useDraft';

type Data = Schemas['DeviceData'];
type Send = { revision: number; data: Data; answer: () => Promise<void> };

const { sent, stored } = vi.hoisted(() => ({
  sent: [] as Send[],
  stored: { revision: 7, data: { description: 'stored' } },
}));

vi.mock('@/api/queries', () => ({
  StaleObject: class StaleObject extends Error {},
  useObject: () => ({ data: stored, error: null }),
  saveObject: (_project: string, _object: string, revision: number, data: Data) =>
    new Promise((resolve) => {
      const answer = async () => {
        await act(() => {
          Object.assign(stored, { revision: revision + 1, data });
          resolve({ ...stored });
          return Promise.resolve();
        });
      };
      sent.push({ revision, data, answer });
    }),
}));
vi.mock('@/workbench/useCommandContext', () => ({ useCommandContext: () => ({}) }));
vi.mock('@/workbench/rights', () => ({ mayEdit: () => true }));
vi.mock('@/workbench/useHandlers', () => ({
  useHandlers: (_panel: string, handlers: Record<string, { run: () => Promise<void> }>) => {
    save = handlers['file.save']!.run;
    undo = handlers['edit.undo']!.run;
  },
}));

let save: () => Promise<void>;
let undo: () => Promise<void>;
let draft: Draft<Data>;
let root: Root;

function Form() {
  const present = useDraft('panel', 'project', 'object', ofKind('device'), () => true);
  useEffect(() => {
    draft = present;
  });
  return null;
}

const described = (description: string) => ({ description }) as Data;
const isDirty = () => useSelection.getState().dirty.has('panel');

beforeEach(() => {
  (globalThis as Record<string, unknown>).IS_REACT_ACT_ENVIRONMENT = true;
  vi.useFakeTimers();
  sent.length = 0;
  Object.assign(stored, { revision: 7, data: { description: 'stored' } });
  localStorage.clear();
  open();
});

/** The form as a page shows it that was just loaded. */
function open(): void {
  root = createRoot(document.createElement('div'));
  act(() => root.render(createElement(Form)));
}
afterEach(() => {
  act(() => root.unmount());
  vi.useRealTimers();
});

describe('a form', () => {
  it('is saved a moment after the change, on the revision it shows', async () => {
    act(() => draft.change(described('a')));
    expect(isDirty()).toBe(true);
    act(() => void vi.advanceTimersByTime(700));
    expect(sent.map(({ revision, data }) => [revision, data.description])).toEqual([[7, 'a']]);
    await sent[0]!.answer();
    expect(isDirty()).toBe(false);
  });

  it('sends one request at a time: Save while it saves itself is no conflict with oneself', async () => {
    act(() => draft.change(described('a')));
    act(() => void vi.advanceTimersByTime(700));
    let done = false;
    const saved = save().then(() => (done = true));
    expect(sent).toHaveLength(1);
    expect(done).toBe(false);
    await sent[0]!.answer();
    await saved;
    expect(sent).toHaveLength(1);
  });

  it('brings what was typed meanwhile on top of the revision just made', async () => {
    act(() => draft.change(described('a')));
    const first = save();
    await act(() => Promise.resolve());
    act(() => draft.change(described('b')));
    const second = save();
    await sent[0]!.answer();
    await act(() => first);
    expect(isDirty()).toBe(true);
    expect(sent.map(({ revision, data }) => [revision, data.description])).toEqual([
      [7, 'a'],
      [8, 'b'],
    ]);
    await sent[1]!.answer();
    await act(() => second);
    expect(draft.data).toEqual({ description: 'b' });
  });

  it('is known to be stored when Save has ended, for what asks right then', async () => {
    act(() => draft.change(described('a')));
    const dirtyAfterSave = save().then(isDirty);
    await act(() => Promise.resolve());
    await sent[0]!.answer();
    expect(await dirtyAfterSave).toBe(false);
  });

  const saveAs = async (description: string) => {
    act(() => draft.change(described(description)));
    const saving = save();
    await sent.at(-1)!.answer();
    await saving;
  };

  it('goes back over changes made before the page was loaded again', async () => {
    await saveAs('one');
    await saveAs('two');
    act(() => root.unmount());
    open();
    act(() => void undo());
    expect(draft.data?.description).toBe('one');
    act(() => void undo());
    expect(draft.data?.description).toBe('stored');
    act(() => void undo());
    expect(draft.data?.description).toBe('stored');
  });

  it('does not go back over what somebody else has changed', async () => {
    await saveAs('one');
    Object.assign(stored, { revision: 20, data: { description: 'by somebody else' } });
    act(() => root.render(createElement(Form)));
    act(() => void undo());
    expect(draft.data?.description).toBe('by somebody else');
    act(() => root.unmount());
    open();
    act(() => void undo());
    expect(draft.data?.description).toBe('by somebody else');
  });
});
