import { describe, expect, it } from 'vitest';
import type { ProjectSummary } from '@/api/types';
import { ago, sections } from './projects';

const project = (id: string, modified: string): ProjectSummary => ({
  id,
  name: id,
  description: `about ${id}`,
  created: modified,
  modified,
  created_by: 'eva',
  modified_by: 'eva',
  revision: 1,
});
const projects = [project('old', '2026-01-01'), project('new', '2026-03-01'), project('mid', '2026-02-01')];
const ids = (list: ProjectSummary[]) => list.map((one) => one.id);

describe('project list', () => {
  it('puts the recent ones first, in the order they were opened', () => {
    const { recent, others } = sections(projects, ['old', 'gone'], '');
    expect(ids(recent)).toEqual(['old']);
    expect(ids(others)).toEqual(['new', 'mid']);
  });

  it('searches names and descriptions', () => {
    expect(ids(sections(projects, ['old'], 'OUT M').others)).toEqual(['mid']);
  });
});

describe('ago', () => {
  const now = Date.parse('2026-03-10T12:00:00Z');
  it('takes the largest unit that fits', () => {
    expect(ago('2026-03-10T09:00:00Z', now, 'en')).toBe('3 hours ago');
    expect(ago('2026-03-09T11:00:00Z', now, 'en')).toBe('yesterday');
    expect(ago('2026-03-10T11:59:50Z', now, 'en')).toBeNull();
    expect(ago('2026-03-10T09:00:00Z', now, 'zh')).toBe('3小时前');
  });
});
