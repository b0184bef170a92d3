import { describe, expect, it } from 'vitest';
import { parseRoute, routeHash } from './route';

describe('routes', () => {
  it('lead to a project and back', () => {
    const route = parseRoute('#/project/0a1b-2');
    expect(route).toEqual({ page: 'project', projectId: '0a1b-2' });
    expect(routeHash(route)).toBe('#/project/0a1b-2');
  });

  it('lead to the start page when they mean nothing', () => {
    for (const hash of ['', '#/', '#/project/', '#/project/../x', '#/other'])
      expect(parseRoute(hash)).toEqual({ page: 'start' });
  });
});
