import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import type { Schemas } from '@/api/types';
import { SRC } from '../../../tests/sources';
import { canStore, LARGEST_HEAP, limitFault, USUAL_HEAP, type HeapData } from './heap';

interface Described {
  default: unknown;
  minimum?: number;
  maximum?: number;
}
const { components } = JSON.parse(readFileSync(join(SRC, 'api/openapi.json'), 'utf8')) as {
  components: { schemas: { HeapData: { properties: Record<keyof HeapData, Described> } } };
};

const application = (limit_kib: number) => ({ heap: { limit_kib, poison: false } }) as Schemas['ApplicationData'];

describe('the limit of dynamic memory', () => {
  it('has the bounds and the usual value of the server', () => {
    const { limit_kib, poison } = components.schemas.HeapData.properties;
    expect([limit_kib.minimum, limit_kib.maximum]).toEqual([0, LARGEST_HEAP]);
    expect({ limit_kib: limit_kib.default, poison: poison.default }).toEqual(USUAL_HEAP);
  });

  it('is a whole number', () => {
    for (const limit of [0, 1, LARGEST_HEAP]) expect(limitFault(limit)).toBeNull();
    for (const limit of [-1, 1.5, LARGEST_HEAP + 1, Number.NaN])
      expect(limitFault(limit)).toBe('application.heapLimitFault');
  });

  it('is not stored when it is none, and need not be said', () => {
    expect(canStore(application(4))).toBe(true);
    expect(canStore(application(Number.NaN))).toBe(false);
    expect(canStore({})).toBe(true);
  });
});
