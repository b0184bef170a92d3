import { beforeAll, describe, expect, it } from 'vitest';
import type { RuntimeException } from '@/api/types';
import { someContext, someSession } from '../../tests/context';
import {
  activeHandler,
  enablementOf,
  findCommand,
  menuGroup,
  registerCommand,
  useRegistry,
  type Command,
  type Handlers,
} from './commands';
import { registerEditCommands } from './commands/edit';
import { registerOnlineCommands } from './commands/online';
import { application, engineer, idle, when } from './conditions';
import { menuOf, toolbarOf } from './frame/menuModel';

const NONE: ReadonlyMap<string, Handlers> = new Map();
const undo: Command = { id: 'edit.undo', title: 'command.undo', delegated: true };
const editor = { panelId: 'ed', objectId: 'o', kind: 'pou', dirty: false };

describe('delegated commands', () => {
  const handlers = new Map<string, Handlers>([
    ['devices', { 'edit.undo': { run: () => undefined, enabled: 'reason.nothingToUndo' } }],
    ['ed', { 'edit.undo': { run: () => undefined } }],
  ]);

  it('are the act of the focused view', () => {
    expect(enablementOf(undo, someContext({ focusedPanel: 'devices', activeEditor: editor }), handlers)).toBe(
      'reason.nothingToUndo',
    );
  });

  it('are that of the active editor where the focused view has none', () => {
    const context = someContext({ focusedPanel: 'messages', activeEditor: editor });
    expect(activeHandler('edit.undo', context, handlers)).toBe(handlers.get('ed')!['edit.undo']);
    expect(enablementOf(undo, context, handlers)).toBe(true);
  });

  it('are not possible where nobody offers them', () => {
    expect(enablementOf(undo, someContext(), NONE)).toBe('reason.notHere');
  });

  it('ask their own condition first', () => {
    const cut: Command = { ...undo, enabled: () => 'reason.nothingSelected' };
    expect(enablementOf(cut, someContext({ focusedPanel: 'ed' }), handlers)).toBe('reason.nothingSelected');
  });
});

describe('undo', () => {
  beforeAll(registerEditCommands);
  const handlers = new Map<string, Handlers>([['ed', { 'edit.undo': { run: () => undefined } }]]);
  const can = (focusedPanel: string) =>
    enablementOf(findCommand('edit.undo')!, someContext({ focusedPanel, activeEditor: editor }), handlers);

  it('in a tree is for who may change the project', () => {
    const viewer = someContext({ focusedPanel: 'devices', activeEditor: editor, role: 'viewer' });
    expect(enablementOf(findCommand('edit.undo')!, viewer, handlers)).not.toBe(true);
    expect(can('messages')).toBe(true);
  });
});

describe('the registry', () => {
  it('forgets a command that is disposed of, unless another has taken its place', () => {
    const first = registerCommand(undo);
    const other = { ...undo };
    registerCommand(other);
    first();
    expect(findCommand('edit.undo')).toBe(other);
  });
});

describe('online commands', () => {
  beforeAll(registerOnlineCommands);
  const can = (id: string, context: ReturnType<typeof someContext>) => enablementOf(findCommand(id)!, context, NONE);

  it('begin with login', () => {
    const context = someContext();
    expect(can('online.login', context)).toBe(true);
    for (const id of ['online.logout', 'online.download', 'debug.start', 'debug.stop', 'online.reset.warm']) {
      expect(can(id, context)).toBe('reason.notLoggedIn');
    }
  });

  it('start what is stopped and stop what runs', () => {
    const stopped = someContext({ online: someSession('stop') });
    const running = someContext({ online: someSession('run') });
    expect([can('debug.start', stopped), can('debug.stop', stopped)]).toEqual([true, 'reason.stopped']);
    expect([can('debug.start', running), can('debug.stop', running)]).toEqual(['reason.running', true]);
    expect([can('debug.singleCycle', stopped), can('debug.singleCycle', running)]).toEqual([true, 'reason.running']);
  });

  it('take a login while logged in as the wish to load what has changed', () => {
    const online = (relation: 'same' | 'online_change' | 'download') =>
      someContext({ online: someSession('run', { relation }) });
    expect(can('online.login', online('same'))).toBe('reason.nothingChanged');
    expect(can('online.login', online('online_change'))).toBe(true);
    expect(can('online.login', online('download'))).toBe(true);
    expect(can('online.login', { ...online('online_change'), role: 'operator' })).toBe('reason.engineer');
  });

  it('want a reset after an exception', () => {
    const context = someContext({ online: someSession('exception') });
    expect(can('debug.start', context)).toBe('reason.exception');
    expect(can('online.reset.cold', context)).toBe(true);
  });

  it('start an application that was not started again after it had ended the process', () => {
    const context = someContext({ online: someSession('exception') });
    context.online!.runtime!.exception = { name: 'PROCESS_ENDED' } as RuntimeException;
    expect(can('debug.start', context)).toBe(true);
    expect(can('debug.singleCycle', context)).toBe('reason.exception');
  });

  it('rest while the connection is lost, but for logout', () => {
    const context = someContext({ online: someSession('run', { lostSince: 1 }) });
    expect(can('debug.stop', context)).toBe('reason.connectionLost');
    expect(can('online.download', context)).toBe('reason.connectionLost');
    expect(can('online.logout', context)).toBe(true);
  });

  it('depend on the role', () => {
    const as = (role: 'viewer' | 'operator') => someContext({ role, online: someSession('stop') });
    expect(can('debug.start', as('viewer'))).toBe('reason.operator');
    expect(can('debug.start', as('operator'))).toBe(true);
    expect(can('online.download', as('operator'))).toBe('reason.engineer');
    expect(can('build.build', someContext({ role: 'operator' }))).toBe('reason.engineer');
    expect(can('online.login', someContext({ role: 'viewer' }))).toBe(true);
  });

  it('offer an online change only after a change', () => {
    expect(can('online.onlineChange', someContext({ online: someSession('run') }))).toBe('reason.nothingChanged');
    const changed = someContext({ online: someSession('run', { relation: 'online_change' }) });
    expect(can('online.onlineChange', changed)).toBe(true);
  });

  it('wait for each other', () => {
    expect(can('build.build', someContext({ busy: true }))).toBe('reason.busy');
  });

  it('have keys that no other has', () => {
    const keys = [...useRegistry.getState().commands.values()].flatMap((command) =>
      (command.keys ?? []).map((each) => `${command.scope ?? ''} ${each.toLowerCase()}`),
    );
    expect(new Set(keys).size).toBe(keys.length);
  });
});

describe('conditions', () => {
  it('that do not hold say why, the first of them', () => {
    const loads = when(application, engineer, idle);
    expect(loads(someContext())).toBe(true);
    expect(loads(someContext({ busy: true }))).toBe('reason.busy');
    expect(loads(someContext({ busy: true, role: 'operator' }))).toBe('reason.engineer');
    expect(loads(someContext({ busy: true, role: null, applicationId: null }))).toBe('reason.noApplication');
    expect(loads(someContext({ projectId: null, applicationId: null }))).toBe('reason.noProject');
  });
});

describe('menus', () => {
  const context = someContext();
  const command = (id: string, group: string, order: number, more: Partial<Command> = {}): Command => ({
    id,
    title: 'command.save',
    menu: { menu: 'file', group, order },
    toolbar: { group, order },
    ...more,
  });

  it('stand in groups by name and in order within', () => {
    const menu = menuOf([command('c', '2_b', 1), command('b', '1_a', 2), command('a', '1_a', 1)], 'file', context);
    expect(menu.map((group) => group.entries.map((entry) => 'id' in entry && entry.id))).toEqual([['a', 'b'], ['c']]);
  });

  it('show the commands of a group in the order in which they are given', () => {
    const { menu: _, ...below } = command('a', '1', 1);
    const group = menuGroup('file', '2_b', { ...below, id: 'z' }, below);
    const [first, second] = menuOf([group[1]!, group[0]!, command('b', '1_a', 9)], 'file', context);
    expect(first!.entries).toMatchObject([{ id: 'b' }]);
    expect(second!.entries).toMatchObject([{ id: 'z' }, { id: 'a' }]);
  });

  it('leave out what is not visible and what belongs to other menus', () => {
    const hidden = command('a', '1', 1, { visible: () => false });
    expect(menuOf([hidden, command('b', '1', 2, { menu: { menu: 'edit', group: '1' } })], 'file', context)).toEqual([]);
  });

  it('gather a submenu where its first entry stands', () => {
    const sub = { menu: 'file', group: '1', submenu: 'menu.view' } as const;
    const menu = menuOf(
      [
        command('x', '1', 1, { menu: { ...sub, order: 2 } }),
        command('y', '1', 1, { menu: { ...sub, order: 3 } }),
        command('a', '1', 1),
      ],
      'file',
      context,
    );
    expect(menu[0]!.entries).toHaveLength(2);
    expect(menu[0]!.entries[1]).toMatchObject({ submenu: 'menu.view', entries: [{ id: 'x' }, { id: 'y' }] });
  });

  it('fill the tool bar in the same way', () => {
    expect(
      toolbarOf([command('b', '2', 1), command('a', '1', 1)], context).map((group) => group.map((one) => one.id)),
    ).toEqual([['a'], ['b']]);
  });
});
