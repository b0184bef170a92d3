/** The results tree of a test run as the rows on screen; pure. */
import type { Schemas, TestFailure, TestReport, TestSuite } from '@/api/types';

export type Outcome = Schemas['TestResult']['outcome'];

/** A suite, a test or a failure in the order of the tree. */
export interface Row {
  id: string;
  level: 1 | 2 | 3;
  text: string;
  outcome: Outcome;
  /** Has rows below. */
  open: boolean | null;
  /** Tests of a suite that are good, and all of them. */
  counts?: { passed: number; total: number };
  seconds?: number;
  failure?: TestFailure;
}

const RANK: readonly Outcome[] = ['skipped', 'passed', 'failed', 'error'];

/** The worst that came of the tests of a suite. */
export function outcomeOf(suite: TestSuite): Outcome {
  if (suite.failures.length > 0) return 'error';
  return suite.tests.reduce<Outcome>(
    (worst, test) => (RANK.indexOf(test.outcome) > RANK.indexOf(worst) ? test.outcome : worst),
    'skipped',
  );
}

/** Names of the tests that are not good, as a run takes them. */
export function namesOfBad(report: TestReport): readonly string[] {
  return report.suites.flatMap((suite) =>
    suite.tests
      .filter((test) => test.outcome === 'failed' || test.outcome === 'error')
      .map((test) => `${suite.name}.${test.name}`),
  );
}

/** What a failure says in one line: `sum: expected 3, but was 2` is built by `words`. */
export type Words = (failure: TestFailure) => string;

/** All rows that are to be seen; suites and tests in `closed` show nothing below them. */
export function rowsOf(
  report: TestReport,
  closed: ReadonlySet<string>,
  onlyBad: boolean,
  words: Words,
): readonly Row[] {
  const rows: Row[] = [];
  const failures = (id: string, list: readonly TestFailure[]) =>
    list.forEach((failure, at) =>
      rows.push({ id: `${id}/${at}`, level: 3, text: words(failure), outcome: 'failed', open: null, failure }),
    );
  report.suites.forEach((suite, number) => {
    const outcome = outcomeOf(suite);
    const bad = outcome === 'failed' || outcome === 'error';
    if (onlyBad && !bad) return;
    const id = String(number);
    const open = !closed.has(id);
    const passed = suite.tests.filter((test) => test.outcome === 'passed').length;
    rows.push({ id, level: 1, text: suite.name, outcome, open, counts: { passed, total: suite.tests.length } });
    if (!open) return;
    failures(`${id}/outside`, suite.failures);
    suite.tests.forEach((test, at) => {
      if (onlyBad && test.failures.length === 0) return;
      const testId = `${id}.${at}`;
      const has = test.failures.length > 0;
      const shown = has && !closed.has(testId);
      const { name: text, seconds } = test;
      rows.push({ id: testId, level: 2, text, outcome: test.outcome, open: has ? shown : null, seconds });
      if (shown) failures(testId, test.failures);
    });
  });
  return rows;
}
