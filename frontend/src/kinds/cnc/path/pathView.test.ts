import { describe, expect, it, vi } from 'vitest';
import { ApiError } from '@/api/client';
import { PathView, type PathServer, type PathState, type Wanted } from './pathView';

const SUMMARY = { objects: 1 } as never;

function fixture(over: Partial<PathServer> = {}) {
  let views = 0;
  const asked: string[] = [];
  const server: PathServer = {
    begin: () => Promise.resolve({ view_id: `v${String(++views)}`, path: `/views/v${String(views)}/` }),
    end: (view) => Promise.resolve(asked.push(`end ${view}`)),
    draw: (view, program) => {
      asked.push(`draw ${view} ${program === null ? 'stored' : 'typed'}`);
      return Promise.resolve(SUMMARY);
    },
    look: (view, looks) => {
      asked.push(`look ${view} ${String(looks.colouring)}`);
      return Promise.resolve(SUMMARY);
    },
    choose: (view, line) => {
      asked.push(`choose ${view} ${String(line)}`);
      return Promise.resolve([]);
    },
    pick: () => Promise.reject(new Error('not asked')),
    motion: () => Promise.reject(new Error('not asked')),
    ...over,
  };
  const states: PathState[] = [];
  const view = new PathView(server, (state) => states.push(state));
  return { view, asked, states, last: () => states.at(-1)! };
}

const wanted = (version: string, line: number | null = null, colouring: 'kind' | 'velocity' = 'kind'): Wanted => ({
  version,
  read: () => null,
  looks: { dark: false, grid: true, colouring, preprocessed: false },
  line,
});

describe('a view of a path', () => {
  it('draws the program and shows the chosen line', async () => {
    const { view, asked, last } = fixture();
    view.show(wanted('1', 3));
    await vi.waitFor(() => expect(last().busy).toBe(false));
    expect(asked).toEqual(['draw v1 stored', 'choose v1 3']);
    expect(last().path).toBe('/views/v1/');
    view.show(wanted('1', 4, 'velocity'));
    await vi.waitFor(() => expect(asked).toHaveLength(4));
    expect(asked.slice(2)).toEqual(['look v1 velocity', 'choose v1 4']);
  });

  it('leaves out what is not wanted any more', async () => {
    let finish: (summary: never) => void = () => undefined;
    const draw = vi.fn(() => new Promise<never>((resolve) => (finish = resolve)));
    const { view } = fixture({ draw });
    view.show(wanted('1'));
    await vi.waitFor(() => expect(draw).toHaveBeenCalledTimes(1));
    for (const version of ['2', '3', '4']) view.show(wanted(version));
    finish(SUMMARY);
    await vi.waitFor(() => expect(draw).toHaveBeenCalledTimes(2));
  });

  it('begins again when its view made room for others', async () => {
    let gone = true;
    const { view, asked, last } = fixture({
      choose: () => {
        if (!gone) return Promise.resolve([]);
        gone = false;
        return Promise.reject(new ApiError({ title: 'gone', status: 404 }));
      },
    });
    view.show(wanted('1', 1));
    await vi.waitFor(() => expect(last().path).toBe('/views/v2/'));
    await vi.waitFor(() => expect(last().busy).toBe(false));
    expect(asked).toEqual(['draw v1 stored', 'draw v2 stored']);
  });

  it('says what went wrong, and tries again when it is told to', async () => {
    let broken = true;
    const { view, last } = fixture({
      draw: () => (broken ? Promise.reject(new ApiError({ title: 'no', status: 422 })) : Promise.resolve(SUMMARY)),
    });
    view.show(wanted('1'));
    await vi.waitFor(() => expect(last().error).toBeInstanceOf(ApiError));
    broken = false;
    view.retry();
    await vi.waitFor(() => expect(last().summary).toBe(SUMMARY));
    expect(last().error).toBeNull();
  });

  it('ends its view with it, even one that just begins', async () => {
    const { view, asked } = fixture();
    view.show(wanted('1'));
    view.close();
    await vi.waitFor(() => expect(asked).toEqual(['end v1']));
  });
});
