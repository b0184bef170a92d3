/** Both readers of the dialect, that of the compiler and that of the editor, find the same errors in the same places. */
import { describe, expect, it } from 'vitest';
import cases from '../../../../tests/cnc/check_cases.json';
import { CncProgram, linesOf } from './program';
import { ORIGIN } from './state';

describe('errors of programs', () => {
  it.each(cases)('$text', ({ text, errors }) => {
    const program = new CncProgram(linesOf(text), { velocity: 100, ready: false, suppress: false }, ORIGIN);
    while (!program.check(7));
    const found = program.findings().filter(({ severity }) => severity === 'error');
    expect(found.map(({ line, at }) => [line, at])).toEqual(errors);
  });
});
