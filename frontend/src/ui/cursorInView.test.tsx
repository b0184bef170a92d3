// @vitest-environment happy-dom
import { useState } from 'react';
import { flushSync } from 'react-dom';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { clear, reads, show } from '../../tests/page';
import { Grid } from './grid/Grid';
import { useGridSelection } from './grid/useGridSelection';
import { Table } from './Table';

const ROW_PX = 26;
const VIEW_PX = 10 * ROW_PX;
const COUNT = 100;

function Cells() {
  const { cursor, selected, move } = useGridSelection(COUNT);
  return (
    <Grid
      label="Rows"
      columns={[{ id: 'name', title: 'Name', width: 100 }]}
      count={COUNT}
      keyOf={String}
      cell={(row) => `row ${String(row)}`}
      selected={selected}
      cursor={cursor}
      onCursor={move}
    />
  );
}

function Rows() {
  const [selected, setSelected] = useState<string | null>(null);
  return (
    <Table
      label="Rows"
      items={Array.from({ length: COUNT }, (_, row) => `row ${String(row)}`)}
      columns={[{ id: 'name', title: 'Name', width: 100, cell: (row) => row }]}
      keyOf={(row) => row}
      selected={selected}
      onSelect={setSelected}
    />
  );
}

beforeEach(() => {
  for (const side of ['clientHeight', 'offsetHeight'] as const)
    vi.spyOn(HTMLElement.prototype, side, 'get').mockReturnValue(VIEW_PX);
  vi.spyOn(HTMLElement.prototype, 'scrollHeight', 'get').mockReturnValue((COUNT + 1) * ROW_PX);
  vi.spyOn(HTMLElement.prototype, 'scrollTo').mockImplementation(function (this: HTMLElement, to: unknown) {
    this.scrollTop = (to as { top: number }).top;
    this.dispatchEvent(new Event('scroll'));
  });
});
afterEach(() => {
  clear();
  vi.restoreAllMocks();
});

it.each([
  ['grid', <Cells />],
  ['table', <Rows />],
])('the row that the keyboard goes to is in view below the head of a %s', async (_, element) => {
  const page = await reads(show(element), 'row 5');
  const scroll = page.querySelector<HTMLElement>('[tabindex="0"]')!;
  const press = async (key: string) => {
    flushSync(() => scroll.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true })));
    await new Promise((done) => requestAnimationFrame(done));
  };
  const inView = (row: number) => {
    // The head is the first row of the content and stays at the top of the view.
    const top = (row + 1) * ROW_PX - scroll.scrollTop;
    expect([row, top]).toEqual([row, Math.min(Math.max(top, ROW_PX), VIEW_PX - ROW_PX)]);
  };
  for (let row = 0; row < 30; row += 1) {
    await press('ArrowDown');
    inView(row);
  }
  for (let row = 28; row >= 0; row -= 1) {
    await press('ArrowUp');
    inView(row);
  }
});
