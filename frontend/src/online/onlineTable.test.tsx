// @vitest-environment happy-dom
import { useEffect, useState } from 'react';
import { flushSync } from 'react-dom';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { clear, reads, show } from '../../tests/page';
import type { OnlineSession } from '@/workbench/onlineSession';
import type { GridColumn } from '@/ui/grid/Grid';
import { OnlineTable } from './OnlineTable';
import type { OnlineRoot, OnlineRow } from './treeRows';

/** Rows whose name has been drawn, in order. */
const drawn = vi.hoisted(() => [] as string[]);
vi.mock('./NameCell', () => ({
  NameCell: ({ row }: { row: OnlineRow }) => {
    drawn.push(row.label);
    return <span>{row.label}</span>;
  },
}));

const COLUMNS: readonly GridColumn[] = [{ id: 'expression', title: 'Expression', width: 100 }];
const root = (label: string): OnlineRoot => ({ key: label, label, expression: label, leaf: true, valueless: true });
const ROOTS = ['a', 'b', 'c'].map(root);
const session = (more: Partial<OnlineSession> = {}): OnlineSession => ({
  applicationId: 'App',
  runtimeId: 'local',
  relation: 'same',
  runtime: null,
  lostSince: null,
  pacedMs: null,
  past: null,
  ...more,
});
let update: (change: { roots?: readonly OnlineRoot[]; session?: OnlineSession }) => void;

function Page() {
  const [given, setGiven] = useState<{ roots: readonly OnlineRoot[]; session: OnlineSession }>({
    roots: ROOTS,
    session: session(),
  });
  useEffect(() => {
    update = (change) => flushSync(() => setGiven((before) => ({ ...before, ...change })));
  }, []);
  return <OnlineTable label="Values" columns={COLUMNS} {...given} />;
}

beforeEach(async () => {
  vi.spyOn(HTMLElement.prototype, 'clientHeight', 'get').mockReturnValue(300);
  vi.spyOn(HTMLElement.prototype, 'clientWidth', 'get').mockReturnValue(300);
  await reads(show(<Page />), 'c');
  drawn.length = 0;
});
afterEach(() => {
  clear();
  vi.restoreAllMocks();
});

it('draws no row again when the runtime tells its state', () => {
  update({ session: session({ relation: 'same' }) });
  expect(drawn).toEqual([]);
});

it('draws the two rows again that the cursor leaves and enters', () => {
  const press = (row: number) => {
    const cells = document.querySelectorAll('[role=gridcell]');
    flushSync(() => cells[row]!.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true, cancelable: true })));
  };
  press(0);
  expect(drawn).toEqual(['a']);
  drawn.length = 0;
  press(2);
  expect(drawn.sort()).toEqual(['a', 'c']);
});

it('draws other rows when there are others', () => {
  update({ roots: [...ROOTS, root('d')] });
  expect(drawn).toContain('d');
});
