import { beforeAll, describe, expect, it } from 'vitest';
import { keys, queryClient } from '@/api/queries';
import type { ObjectSummary } from '@/api/types';
import { partLabels } from './labels';

const object = (id: string, parent_id: string | null, kind: string, name: string) =>
  ({ id, parent_id, kind, name, index: 0 }) as ObjectSummary;
const uri = (path: string) => ({ path, toString: () => `tappet:${path}` });

beforeAll(() => {
  queryClient.setQueryData(keys.objects('p'), [
    object('a', null, 'application', 'Application'),
    object('f', 'a', 'pou', 'FB_Motor'),
    object('m', 'f', 'method', 'Start'),
  ]);
});

describe('labels of texts', () => {
  it('name the object and the part', () =>
    expect(partLabels.getUriBasenameLabel(uri('/p/m/implementation'))).toBe('Start – Implementation'));
  it('give the path of the object', () =>
    expect(partLabels.getUriLabel(uri('/p/m'))).toBe('Application.FB_Motor.Start'));
  it('leave other addresses alone', () => {
    const other = { path: '/Standard/TON', toString: () => 'tappet-library:/Standard/TON' };
    expect(partLabels.getUriBasenameLabel(other)).toBe('TON');
    expect(partLabels.getUriLabel(other)).toBe('/Standard/TON');
  });
});
