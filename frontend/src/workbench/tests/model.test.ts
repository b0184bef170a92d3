import { describe, expect, it } from 'vitest';
import type { TestFailure, TestReport, TestSuite } from '@/api/types';
import { namesOfBad, outcomeOf, rowsOf, type Outcome } from './model';

const failure = (message: string): TestFailure => ({
  message,
  expected: '3',
  actual: '2',
  code: 0,
  pou: 'FB_Sum_Test.Bad',
  object_id: 'o',
  object_path: 'FB_Sum_Test/Bad',
  part: 'implementation',
  element: null,
  line: 2,
  call_stack: [],
});
const suite = (name: string, outcomes: readonly Outcome[], outside: readonly string[] = []): TestSuite => ({
  name,
  block: name,
  object_id: null,
  failures: outside.map(failure),
  tests: outcomes.map((outcome, at) => ({
    name: `t${at}`,
    outcome,
    assertions: 1,
    seconds: 0,
    failures: outcome === 'failed' || outcome === 'error' ? [failure('sum')] : [],
  })),
});
const report = (...suites: TestSuite[]): TestReport => ({
  ok: false,
  total: 0,
  passed: 0,
  failed: 0,
  error: 0,
  skipped: 0,
  problem: null,
  suites,
  diagnostics: [],
});
const ids = (...args: Parameters<typeof rowsOf>) => rowsOf(...args).map((row) => row.id);
const words = (one: TestFailure) => one.message;

describe('the results tree', () => {
  it('gives a suite the worst of its tests', () => {
    expect(outcomeOf(suite('A', ['passed', 'skipped']))).toBe('passed');
    expect(outcomeOf(suite('A', ['passed', 'failed', 'error', 'passed']))).toBe('error');
    expect(outcomeOf(suite('A', ['passed'], ['division by zero']))).toBe('error');
    expect(outcomeOf(suite('A', []))).toBe('skipped');
  });

  it('shows suites, tests and failures in order', () => {
    const rows = rowsOf(report(suite('A', ['passed', 'failed']), suite('B', [], ['outside'])), new Set(), false, words);
    expect(rows.map((row) => [row.id, row.level, row.open])).toEqual([
      ['0', 1, true],
      ['0.0', 2, null],
      ['0.1', 2, true],
      ['0.1/0', 3, null],
      ['1', 1, true],
      ['1/outside/0', 3, null],
    ]);
    expect(rows[0]!.counts).toEqual({ passed: 1, total: 2 });
  });

  it('hides what is closed and, when asked, what is good', () => {
    const all = report(suite('A', ['passed', 'failed']), suite('B', ['passed']));
    expect(ids(all, new Set(['0.1', '1']), false, words)).toEqual(['0', '0.0', '0.1', '1']);
    expect(ids(all, new Set(['0']), false, words)).toEqual(['0', '1', '1.0']);
    expect(ids(all, new Set(), true, words)).toEqual(['0', '0.1', '0.1/0']);
  });
});

describe('a run of what was not good', () => {
  it('names failed tests and those with errors', () => {
    expect(namesOfBad(report(suite('A', ['passed', 'failed']), suite('B', ['error', 'skipped'])))).toEqual([
      'A.t1',
      'B.t0',
    ]);
  });
});
