import { expect, it } from 'vitest';
import { PastView, type PastViewState } from './pastView';

class Gone extends Error {}

/** A server whose answers come when the test says so. */
class World {
  readonly calls: string[] = [];
  readonly states: PastViewState[] = [];
  private answers: { done: (path: string) => void; fail: (error: unknown) => void }[] = [];
  private opened = 0;
  readonly view = new PastView(
    {
      open: (cycle) => this.call(`open ${String(cycle)}`),
      move: (path, cycle) => this.call(`${path} to ${String(cycle)}`),
      gone: (error) => error instanceof Gone,
    },
    (state) => this.states.push(state),
  );

  private call(text: string): Promise<string> {
    this.calls.push(text);
    return new Promise((done, fail) => this.answers.push({ done, fail }));
  }

  async answer(error?: unknown): Promise<void> {
    const next = this.answers.shift()!;
    if (error !== undefined) next.fail(error);
    else next.done(`view ${String((this.opened += 1))}`);
    await new Promise((done) => setTimeout(done, 0));
  }
}

it('opens one view and moves it from then on', async () => {
  const world = new World();
  world.view.show(7);
  await world.answer();
  world.view.show(8);
  await world.answer();
  expect(world.calls).toEqual(['open 7', 'view 1 to 8']);
  expect(world.states).toEqual([{ path: 'view 1', error: null }]);
});

it('asks for the latest cycle alone when the bar is faster than the server', async () => {
  const world = new World();
  [1, 2, 3, 4].forEach((cycle) => world.view.show(cycle));
  await world.answer();
  [5, 6].forEach((cycle) => world.view.show(cycle));
  await world.answer();
  await world.answer();
  expect(world.calls).toEqual(['open 1', 'view 1 to 4', 'view 1 to 6']);
});

it('opens another view when its own is gone', async () => {
  const world = new World();
  world.view.show(1);
  await world.answer();
  world.view.show(2);
  await world.answer(new Gone());
  await world.answer();
  expect(world.calls).toEqual(['open 1', 'view 1 to 2', 'open 2']);
  expect(world.states.at(-1)).toEqual({ path: 'view 2', error: null });
});

it('says why a cycle is not shown, and goes on with the next one', async () => {
  const world = new World();
  const error = new Error('cycle 9 is not kept');
  world.view.show(9);
  await world.answer(error);
  expect(world.states).toEqual([{ path: null, error }]);
  world.view.show(3);
  await world.answer();
  expect(world.states.at(-1)).toEqual({ path: 'view 1', error: null });
});

it('tells nothing after it was closed', async () => {
  const world = new World();
  world.view.show(1);
  world.view.close();
  await world.answer();
  expect(world.states).toEqual([]);
});
