import { describe, expect, it } from 'vitest';
import type { Diagnostic, ObjectSummary, Severity } from '@/api/types';
import { marksOf } from './marks';

const object = (id: string, kind: string, parent_id: string | null, subkind: string | null = null): ObjectSummary => ({
  id,
  kind,
  parent_id,
  subkind,
  name: id,
  index: 0,
  revision: 1,
  excluded: false,
});
const objects = [
  object('App', 'application', null),
  object('PLC_PRG', 'pou', 'App', 'program'),
  object('FB', 'pou', 'App', 'function_block'),
  object('GVL', 'gvl', 'App'),
  object('Shared', 'gvl', null),
  object('Other', 'application', null),
  object('GVL2', 'gvl', 'Other'),
];
const message = (object_id: string | null, severity: Severity) => ({ object_id, severity }) as Diagnostic;

describe('marks', () => {
  it('show the worst message of an object', () => {
    const marks = marksOf(
      objects,
      [
        message('FB', 'warning'),
        message('FB', 'error'),
        message('FB', 'warning'),
        message('GVL', 'info'),
        message(null, 'error'),
      ],
      new Map(),
    );
    expect([...marks]).toEqual([['FB', { severity: 'error' }]]);
  });

  it('show where something is forced, in the application that is logged in', () => {
    const marks = marksOf(objects, [], new Map([['App', ['plc_prg.fb1.x', 'GVL.a[3]', 'Shared.s', 'GVL2.z']]]));
    expect([...marks.keys()]).toEqual(['PLC_PRG', 'GVL', 'Shared']);
    expect(marks.get('GVL')).toEqual({ forced: true });
  });
});
