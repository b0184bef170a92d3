import { describe, expect, it } from 'vitest';
import type { FlowStatement } from '@/api/types';
import { Executed } from './executed';

function statement(line: number, endLine: number, values: Record<string, string>): FlowStatement {
  const listed = Object.entries(values).map(([name, literal]) => ({ name, literal }));
  return { line, end_line: endLine, element: null, part: 'implementation', count: 1, values: listed };
}

// 3 IF nA > 0      4    AND xB THEN      5 nA := 1; nA := 2;      7 list[ i ] := nA;
const executed = new Executed({
  object_id: 'o',
  cycle: 7,
  statements: [
    statement(3, 4, { nA: '5', xB: 'TRUE' }),
    statement(5, 5, { nA: '1' }),
    statement(5, 5, { nA: '2' }),
    statement(7, 7, { 'list[ i ]': '2', i: '1', nA: '2' }),
  ],
});

describe('what a cycle has executed', () => {
  it('is known line by line', () => {
    expect(executed.lines).toEqual([3, 4, 5, 7]);
    expect(executed.has(6)).toBe(false);
  });

  it('has the values of the last statement of a line', () => {
    expect(executed.valueAt(5, 'nA')).toBe('2');
    expect(executed.valueAt(4, 'nA')).toBe('5');
  });

  it('knows a variable however it is written', () => {
    expect(executed.valueAt(7, 'LIST[i]')).toBe('2');
  });

  it('says nothing of what the line does not name', () => {
    expect(executed.valueAt(5, 'xB')).toBeNull();
    expect(executed.valueAt(6, 'nA')).toBeNull();
  });
});
