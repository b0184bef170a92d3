import { describe, expect, it } from 'vitest';
import { changedByOthers, revisionMade } from './authors';

describe('a newer revision', () => {
  it('is ours only when we made it, and nobody else one in between', () => {
    expect(changedByOthers('a', 1, 2)).toBe(true); // no event told of it
    revisionMade('a', 2, false);
    expect(changedByOthers('a', 1, 2)).toBe(false);
    revisionMade('a', 3, true);
    revisionMade('a', 4, false);
    expect(changedByOthers('a', 2, 4)).toBe(true);
    expect(changedByOthers('a', 3, 4)).toBe(false);
  });
});
