import { describe, expect, it } from 'vitest';
import { addressOf, RefusedRequest } from './requests';
import { hashOf, isOwn } from './trust';

describe('requests of scripts', () => {
  it('go below /api/v1 with their query', () => {
    expect(addressOf('/projects', undefined)).toBe('/api/v1/projects');
    expect(addressOf('/projects/a b/objects', { kind: ['pou', 'gvl'], n: 3, none: null })).toBe(
      '/api/v1/projects/a%20b/objects?kind=pou&kind=gvl&n=3',
    );
    expect(addressOf('/projects?deleted=true', { x: 'a&b' })).toBe('/api/v1/projects?deleted=true&x=a%26b');
    expect(addressOf('/users-guide', undefined)).toBe('/api/v1/users-guide');
  });

  it.each([
    'projects', '', 'http://other/api/v1/projects', '/../v2', '/..', '/%2e%2e/%2e%2e/views', '/projects/../../../x',
    '/a/..%2f..%2fx', '/%', '/..\\..\\x',
  ])('to %j are refused', (path) => {
    expect(() => addressOf(path, undefined)).toThrow(RefusedRequest);
  }); // prettier-ignore

  it.each(['/auth/tokens', '/users', '/users/1', '/me/settings/x', '/%61uth/me', '/AUTH/me', '//users', '/x/../users'])(
    'to accounts are refused: %j',
    (path) => {
      expect(() => addressOf(path, undefined)).toThrow(RefusedRequest);
    },
  );
});

describe('a text', () => {
  const by = (author: string, action: string) => ({ author, action });

  it("is one's own where nobody else has written at it", () => {
    expect(isOwn([by('eve', 'add'), by('eve', 'save')], 'eve')).toBe(true);
    expect(isOwn([by('eve', 'add'), by('mallory', 'save')], 'eve')).toBe(false);
    expect(isOwn([by('eve', 'import'), by('eve', 'save')], 'eve')).toBe(false);
    expect(isOwn([by('eve', 'copy')], 'eve')).toBe(false);
    expect(isOwn([], 'eve')).toBe(false);
  });

  it('is known again by SHA-256', async () => {
    // FIPS 180-2, appendix B.1.
    expect(await hashOf('abc')).toBe('ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad');
  });
});
