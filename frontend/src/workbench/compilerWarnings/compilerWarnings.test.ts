import { expect, it } from 'vitest';
import type { CompilerWarning } from '@/api/types';
import { isCompilerWarning, matching, switched } from './model';

const warning = (code: string, numbers: string[], message: string): CompilerWarning => ({
  code,
  numbers,
  message,
  advice: '',
  severity: 'warning',
});
const warnings = [
  warning('W1001', ['C0195'], 'Implicit conversion'),
  warning('W1122', ['SA0054'], 'Comparison of real numbers'),
];
const found = (search: string) => matching(warnings, search).map(({ code }) => code);

it('finds warnings by code, number of CODESYS and words of the text', () => {
  expect(found('')).toEqual(['W1001', 'W1122']);
  expect(found('sa0054')).toEqual(['W1122']);
  expect(found(' numbers COMPARISON ')).toEqual(['W1122']);
  expect(found('w1001 comparison')).toEqual([]);
});

it('keeps each code that is off once, in order', () => {
  expect(switched(['W1122'], ['W1001', 'W1122'], false)).toEqual(['W1001', 'W1122']);
  expect(switched(['W1001', 'W1122'], ['W1001'], true)).toEqual(['W1122']);
});

it('switches off neither errors nor coding rules', () => {
  expect(isCompilerWarning('W1122', 'warning')).toBe(true);
  expect(isCompilerWarning('W1211', 'info')).toBe(true);
  expect(isCompilerWarning('W1122', 'error')).toBe(false);
  expect(isCompilerWarning('S1211', 'warning')).toBe(false);
});
