import { describe, expect, it } from 'vitest';
import type { TaskGroup } from '@/api/types';
import { canStore, counterOf, EVENTS, freeGroupName, groupFault, processorsFrom } from './events';

const group = (name: string): TaskGroup => ({ name, processors: [], policy: 'fifo' });

describe('system events', () => {
  it('have a counter each', () => {
    expect(EVENTS).toContain('StartDone');
    expect(counterOf('StartDone')).toBe('IoConfig_SystemEvents.udiStartDone');
  });
  it('need the name of a function', () => {
    const call = { event: 'StartDone' as const, description: '', active: true };
    expect(canStore({ groups: [], system_events: [{ ...call, function: 'OnStart' }] })).toBe(true);
    expect(canStore({ groups: [], system_events: [{ ...call, function: '2nd' }] })).toBe(false);
  });
});

describe('task groups', () => {
  it('take processors by number, each once and in order', () => {
    expect(processorsFrom(' 3, 1;1 ')).toEqual([1, 3]);
    expect(processorsFrom('')).toEqual([]);
    expect(processorsFrom('one')).toBeNull();
    expect(processorsFrom('-1')).toBeNull();
    expect(processorsFrom('1024')).toBeNull();
  });
  it('have a name of their own', () => {
    expect(freeGroupName([group('group1'), group('Motion')])).toBe('Group2');
    expect(groupFault([group('A'), group('a')], 0)).toBe('taskGroup.twice');
    expect(groupFault([group('my group')], 0)).toBe('taskGroup.nameFault');
    expect(groupFault([group('A'), group('B')], 1)).toBeNull();
    expect(canStore({ system_events: [], groups: [group('A'), group('A')] })).toBe(false);
  });
});
