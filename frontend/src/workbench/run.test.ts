import { beforeEach, describe, expect, it } from 'vitest';
import { registerCommands, type Command } from './commands';
import { useNotices } from '@/ui/notices';
import { runCommand } from './run';

const refused = (id: string, quiet?: boolean): Command => ({
  id,
  title: 'command.save',
  quiet,
  enabled: () => 'reason.nothingToSave',
  run: () => Promise.reject(new Error('must not run')),
});

beforeEach(() => useNotices.setState({ notices: [] }));

describe('a command that is not possible now', () => {
  it('says why', async () => {
    registerCommands([refused('test.loud')]);
    await runCommand('test.loud');
    expect(useNotices.getState().notices).toHaveLength(1);
    expect(useNotices.getState().notices[0]?.tone).toBe('info');
  });

  it('says nothing where the key is pressed out of habit', async () => {
    registerCommands([refused('test.quiet', true)]);
    await runCommand('test.quiet');
    expect(useNotices.getState().notices).toEqual([]);
  });
});
