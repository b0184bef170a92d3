import { describe, expect, it } from 'vitest';
import type { LogEntry } from '@/api/types';
import { levelOf, logCsv, merged, shownEntries } from './log';

const entry = (id: number, message = `m${id}`, severity = 'info'): LogEntry => ({
  id,
  at: '2026-01-01T00:00:00Z',
  severity,
  component: 'plc',
  message,
});

describe('log', () => {
  it('keeps every line once', () => {
    expect(merged([entry(1), entry(2)], [entry(2), entry(3)]).map((one) => one.id)).toEqual([1, 2, 3]);
  });

  it('shows the newest first, without what is hidden', () => {
    const lines = shownEntries([entry(1), entry(2, 'x', 'ERROR'), entry(3)], new Set(['error']), '');
    expect(lines.map((one) => one.id)).toEqual([3, 1]);
    expect(shownEntries([entry(1), entry(2)], new Set(), 'M2').map((one) => one.id)).toEqual([2]);
  });

  it('knows severities in several words', () => {
    expect(['Exception', 'warn', 'debug'].map(levelOf)).toEqual(['error', 'warning', 'info']);
  });

  it('exports cells that no spreadsheet runs', () => {
    expect(logCsv([entry(1, '=cmd "x"')]).split('\r\n')[1]).toBe(`"2026-01-01T00:00:00Z","info","plc","'=cmd ""x"""`);
  });
});
