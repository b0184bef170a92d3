import { beforeEach, describe, expect, it, vi } from 'vitest';
import { saveObjects } from '@/api/queries';
import type { ProjectObject } from '@/api/types';
import type { Put, TextDocument } from './documents';
import { saveTogether } from './saveTogether';

vi.mock('@/api/queries', () => ({ saveObjects: vi.fn() }));
const save = vi.mocked(saveObjects);

/** A document that stores `text` on top of revision 3, or has nothing to store. */
function document(objectId: string, text: string | null) {
  const outcome: unknown[] = [];
  const saveBy = async (put: Put) => {
    if (text === null) return;
    await put(3, { declaration: '', implementation: text }).then(
      (answer) => outcome.push(answer.revision),
      (error: unknown) => outcome.push(error),
    );
  };
  return { outcome, document: { objectId, name: objectId, saveBy } as unknown as TextDocument };
}

describe('texts stored together', () => {
  beforeEach(() => {
    save.mockReset();
  });

  it('go in one request, and each document gets its own answer', async () => {
    const [a, unchanged, b] = [document('a', 'x'), document('u', null), document('b', 'y')];
    save.mockResolvedValue([
      { id: 'b', revision: 8 },
      { id: 'a', revision: 4 },
    ] as ProjectObject[]);
    await saveTogether(
      'p',
      [a, unchanged, b].map((one) => one.document),
      'why',
    );
    expect(save).toHaveBeenCalledExactlyOnceWith(
      'p',
      [
        { object_id: 'a', base_revision: 3, data: { declaration: '', implementation: 'x' } },
        { object_id: 'b', base_revision: 3, data: { declaration: '', implementation: 'y' } },
      ],
      'why',
    );
    expect([a.outcome, unchanged.outcome, b.outcome]).toEqual([[4], [], [8]]);
  });

  it('are refused together', async () => {
    const refusal = new Error('stale');
    const [a, b] = [document('a', 'x'), document('b', 'y')];
    save.mockRejectedValue(refusal);
    const caught = await saveTogether('p', [a.document, b.document], '').catch((error: unknown) => error);
    expect(caught).toBe(refusal);
    expect([a.outcome, b.outcome]).toEqual([[refusal], [refusal]]);
  });

  it('ask nothing of the server when nothing is changed', async () => {
    await saveTogether('p', [document('u', null).document], '');
    expect(save).not.toHaveBeenCalled();
  });
});
