import { expect, test } from 'vitest';
import { completed, tappetCommand } from '../src/command';

test('the command is the setting with what is to be done behind it', () => {
  expect(tappetCommand(['python', '-m', 'tappet'], 'lsp', '--stdio')).toEqual({
    program: 'python',
    arguments: ['-m', 'tappet', 'lsp', '--stdio'],
  });
});

test.each([[undefined], ['tappet'], [[]], [['']], [['tappet', 1]]])('%j names no program', (setting) => {
  expect(tappetCommand(setting, 'dap')).toBeUndefined();
});

test('without a launch.json the open file is debugged, or the folder', () => {
  expect(completed({}, '/machine/Main.ST')).toMatchObject({ type: 'tappet', request: 'launch', program: '${file}' });
  expect(completed({}, '/machine/readme.md')['program']).toBe('${workspaceFolder}');
  expect(completed({}, undefined)['program']).toBe('${workspaceFolder}');
});

test('a configuration of the user stays as it is', () => {
  const own = { type: 'tappet', request: 'attach', name: 'Line 1', program: '/p', runtime: 'ws://plc:11740' };
  expect(completed(own, '/machine/Main.st')).toEqual(own);
});
