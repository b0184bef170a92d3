import { describe, expect, it } from 'vitest';
import type { ObjectSummary, TaskData } from '@/api/types';
import {
  callablePrograms,
  canStore,
  externalEvent,
  intervalFrom,
  intervalNs,
  movedPou,
  taskFaults,
  shownInterval,
  unitOf,
} from './model';

const task = (changes: Partial<TaskData> = {}): TaskData => ({
  priority: 1,
  type: 'cyclic',
  interval: 't#20ms',
  event: '',
  watchdog: { enabled: false, time: 't#100ms', percent: null, sensitivity: 1 },
  group: '',
  pous: [],
  ...changes,
});

describe('times', () => {
  it('are entered as numbers with a unit (tasks EX-04)', () => {
    expect(intervalFrom('200', 'ms')).toBe('t#200ms');
    expect(intervalFrom('300', 'us')).toBe('300');
    expect(intervalFrom('t#500us', 'ms')).toBe('t#500us');
    expect(intervalFrom('abc', 'ms')).toBeNull();
    expect(intervalFrom('0.5', 'us')).toBeNull();
  });

  it('are shown with the unit they were entered in', () => {
    expect(shownInterval('t#20ms', 'ms')).toBe('20');
    expect(shownInterval('T#1s500ms', 'ms')).toBe('1500');
    expect(shownInterval('t#500us', 'ms')).toBe('0.5');
    expect(shownInterval('t#20ms', 'us')).toBe('20000');
    expect(shownInterval('300', 'us')).toBe('300');
    expect(shownInterval('t#100ns', 'us')).toBe('t#100ns');
    expect(shownInterval('soon', 'ms')).toBe('soon');
    expect(unitOf('300')).toBe('us');
    expect(unitOf('t#200ms')).toBe('ms');
    expect(intervalNs('300')).toBe(300_000);
  });
});

describe('settings', () => {
  it('have their limits', () => {
    expect(taskFaults(task())).toEqual({});
    expect(taskFaults(task({ priority: 32 }))).toEqual({ priority: 'task.priorityFault' });
    expect(taskFaults(task({ priority: 1.5 })).priority).toBeDefined();
    expect(taskFaults(task({ interval: '0' })).interval).toBe('task.intervalFault');
    expect(taskFaults(task({ type: 'freewheeling', interval: 'x' }))).toEqual({});
    expect(taskFaults(task({ watchdog: { enabled: true, time: 't#0ms', percent: null, sensitivity: -1 } }))).toEqual({
      watchdogTime: 'task.timeFault',
      sensitivity: 'task.sensitivityFault',
    });
  });

  it('are those of the device, up to their last value (TASK-07)', () => {
    const watchdog = { enabled: true, time: 't#1s', percent: 1_000_000, sensitivity: 1_000_000 };
    for (const priority of [0, 31]) expect(taskFaults(task({ priority, watchdog }))).toEqual({});
    expect(taskFaults(task({ priority: -1 })).priority).toBe('task.priorityFault');
    expect(taskFaults(task({ watchdog: { ...watchdog, percent: 1_000_001 } })).watchdogPercent).toBe(
      'task.percentFault',
    );
    expect(taskFaults(task({ watchdog: { ...watchdog, sensitivity: 1_000_001 } })).sensitivity).toBe(
      'task.sensitivityFault',
    );
  });

  it('may have a watchdog in percent of the interval (TASK-30)', () => {
    const watchdog = { enabled: true, time: 't#0ms', percent: 150, sensitivity: 1 };
    expect(taskFaults(task({ watchdog }))).toEqual({});
    expect(taskFaults(task({ type: 'freewheeling', watchdog })).watchdogTime).toBeDefined();
    expect(taskFaults(task({ watchdog: { ...watchdog, percent: 0 } })).watchdogPercent).toBeDefined();
  });

  it('name an event of the controller (TASK-16)', () => {
    expect(taskFaults(task({ type: 'external', event: 'sigusr1' }))).toEqual({});
    expect(taskFaults(task({ type: 'external', event: 'GVL.x' })).event).toBe('task.externalFault');
    expect(externalEvent(' startdone')).toBe('StartDone');
  });

  it('may be stored before the event variable is known', () => {
    const event = task({ type: 'event' });
    expect(taskFaults(event).event).toBe('task.eventFault');
    expect(canStore(event)).toBe(true);
    expect(canStore(task({ priority: -1 }))).toBe(false);
  });
});

describe('programs', () => {
  it('move and stop at the ends', () => {
    const pous = ['A', 'B', 'C'].map((name) => ({ name, comment: '' }));
    expect(movedPou(pous, 2, -1).map((pou) => pou.name)).toEqual(['A', 'C', 'B']);
    expect(movedPou(pous, 0, -1).map((pou) => pou.name)).toEqual(['A', 'B', 'C']);
  });

  it('are offered from the own application first, and not twice', () => {
    const object = (id: string, kind: string, parent_id: string | null, name = id): ObjectSummary => ({
      id,
      kind,
      parent_id,
      name,
      subkind: kind === 'pou' ? 'program' : null,
      index: 0,
      revision: 1,
      excluded: false,
    });
    const objects = [
      object('App', 'application', null),
      object('Other', 'application', null),
      object('Task', 'task', 'App'),
      object('own', 'pou', 'App', 'Main'),
      object('foreign', 'pou', 'Other', 'Foreign'),
      object('hidden', 'pou', null, 'MAIN'),
      object('shared', 'pou', null, 'Shared'),
    ];
    expect(callablePrograms(objects, 'Task').map((program) => program.id)).toEqual(['own', 'shared']);
  });
});
