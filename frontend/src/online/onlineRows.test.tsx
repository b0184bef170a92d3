// @vitest-environment happy-dom
import { useEffect, useState } from 'react';
import { flushSync } from 'react-dom';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { clear, reads, show } from '../../tests/page';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { GridColumn } from '@/ui/grid/Grid';
import { ValueBoard } from './board';
import { OnlineTable } from './OnlineTable';
import type { OnlineRoot } from './treeRows';

/** What each view asks the runtime for at present. */
const groups = vi.hoisted(() => new Set<{ expressions: readonly string[] }>());
vi.mock('./connections', () => ({
  channelOf: (runtimeId: string | null) => (runtimeId === null ? null : channel),
}));
const channel = {
  board: new ValueBoard({ now: () => 0, soon: (callback) => queueMicrotask(callback) }),
  watch: (expressions: readonly string[]) => {
    const group = { expressions };
    groups.add(group);
    return {
      update: (next: readonly string[]) => (group.expressions = next),
      release: () => groups.delete(group),
    };
  },
};

const COUNT = 1000;
const ROW_PX = 26;
const COLUMNS: readonly GridColumn[] = [
  { id: 'expression', title: 'Expression', width: 100 },
  { id: 'value', title: 'Value', width: 100 },
];
const ROOTS = Array.from({ length: COUNT }, (_, row): OnlineRoot => ({
  key: `v${String(row)}`,
  label: `v${String(row)}`,
  expression: `v${String(row)}`,
  kind: 'int',
  leaf: true,
}));
const SESSION: OnlineSession = {
  applicationId: 'App',
  runtimeId: 'local',
  relation: 'same',
  runtime: null,
  lostSince: null,
  pacedMs: null,
  past: null,
};
let setVisible: (visible: boolean) => void;

function Page() {
  const [visible, change] = useState(true);
  useEffect(() => {
    setVisible = (next) => flushSync(() => change(next));
  }, []);
  return <OnlineTable label="Values" columns={COLUMNS} session={SESSION} roots={ROOTS} visible={visible} />;
}

const asked = () => [...groups].flatMap(({ expressions }) => expressions);

beforeEach(async () => {
  vi.spyOn(HTMLElement.prototype, 'clientHeight', 'get').mockReturnValue(10 * ROW_PX);
  vi.spyOn(HTMLElement.prototype, 'clientWidth', 'get').mockReturnValue(300);
  await reads(show(<Page />), 'v9');
});
afterEach(() => {
  clear();
  groups.clear();
  vi.restoreAllMocks();
});

it('asks for the rows on screen and some around them, of a thousand', async () => {
  expect(asked()).toContain('v0');
  expect(asked().length).toBeLessThan(100);
  const table = document.querySelector('[role=treegrid]')!;
  table.scrollTop = 500 * ROW_PX;
  table.dispatchEvent(new Event('scroll'));
  await vi.waitFor(() => expect(asked()).toContain('v505'));
  expect(asked()).not.toContain('v0');
  expect(asked().length).toBeLessThan(100);
});

it('asks for nothing while another panel is in front', async () => {
  await vi.waitFor(() => expect(asked()).toContain('v0'));
  setVisible(false);
  await vi.waitFor(() => expect(asked()).toEqual([]));
  setVisible(true);
  await vi.waitFor(() => expect(asked()).toContain('v0'));
});
