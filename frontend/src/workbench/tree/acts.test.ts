import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { renameObject, undoChange } from './acts';

const PROJECT = 'p';
const object = { id: 'o', name: 'PLC_PRG', kind: 'pou', parent_id: null, index: 0, revision: 1 } as ObjectSummary;

/** Requests that the server has not answered yet. */
const waiting: { request: Request; answer: (response: Response) => void }[] = [];
const asked = () => waiting.map(({ request }) => `${request.method} ${new URL(request.url).pathname}`);
const settled = () => new Promise((resolve) => setTimeout(resolve));
const json = (body: unknown, status = 200) =>
  new Response(JSON.stringify(body), { status, headers: { 'Content-Type': 'application/json' } });

beforeEach(() => {
  vi.stubGlobal('document', { documentElement: {} });
  vi.stubGlobal('location', new URL('http://tappet.test/#/'));
  vi.stubGlobal('fetch', (request: Request) => new Promise<Response>((answer) => waiting.push({ request, answer })));
  queryClient.setQueryData(keys.objects(PROJECT), [object]);
});
afterEach(() => {
  waiting.length = 0;
  queryClient.clear();
  vi.unstubAllGlobals();
});

const OBJECT = `/api/v1/projects/${PROJECT}/objects/o`;
const UNDO = `/api/v1/projects/${PROJECT}/undo`;

it('takes a change back only when the server has it', async () => {
  const rename = renameObject(PROJECT, object, 'Main');
  const undo = undoChange(PROJECT, 'undo');
  await settled();
  expect(queryClient.getQueryData<ObjectSummary[]>(keys.objects(PROJECT))![0]!.name).toBe('Main');
  expect(asked()).toEqual([`PATCH ${OBJECT}`]);
  waiting[0]!.answer(json({ ...object, name: 'Main', revision: 2 }));
  await rename;
  await settled();
  expect(asked()).toEqual([`PATCH ${OBJECT}`, `POST ${UNDO}`]);
  waiting[1]!.answer(json({ done: 'rename', touched: [] }));
  expect((await undo).done).toBe('rename');
});

it('goes on after a change that the server refuses', async () => {
  const rename = renameObject(PROJECT, object, 'Main');
  const undo = undoChange(PROJECT, 'undo');
  await settled();
  waiting[0]!.answer(json({ title: 'Conflict', status: 409, detail: 'Taken' }, 409));
  await expect(rename).rejects.toThrow();
  await settled();
  expect(asked()[1]).toBe(`POST ${UNDO}`);
  waiting[1]!.answer(json({ done: 'delete', touched: [] }));
  expect((await undo).done).toBe('delete');
});
