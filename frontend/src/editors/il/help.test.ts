/** What stands around the cells: proposals, messages, values, what can be edited. */
import { describe, expect, it } from 'vitest';
import type { CompletionItem } from '@/lsp/protocol';
import { preselected } from '@/ui/grid/useProposals';
import { editedColumn } from './columns';
import { operandName } from './facts';
import { messagesByRow } from './messages';
import { fitting, positionAt, trial } from './proposals';
import { parseRows } from './rows';
import { usesByRow } from './values';

const item = (label: string, start: number, end: number, more: Partial<CompletionItem> = {}): CompletionItem => ({
  label,
  textEdit: { range: { start: { line: 0, character: start }, end: { line: 0, character: end } }, newText: label },
  ...more,
});

describe('proposals in a cell', () => {
  it('are asked with the text as it would be', () => {
    expect(trial('LD a\nST b', 1, 'operand', 'inst.')).toEqual({ text: 'LD a\nST inst.Q_', start: 8 });
    expect(trial('    LD a\n', 1, 'operator', '')).toEqual({ text: '    LD a\n    Q_', start: 13 });
    expect(trial('LD a', 7, 'operator', '')).toBeNull();
    expect(positionAt('LD a\nST inst.Q_', 13)).toEqual({ line: 1, character: 8 });
  });

  it('begin with what is typed, then hold it; snippets and doubles are left out', () => {
    const items = [
      item('LIMIT', 8, 8),
      item('xLimit', 8, 8),
      item('LI_A', 8, 8, { insertTextFormat: 2 }),
      item('LIMIT', 8, 8),
      item('ADD', 8, 8),
    ];
    expect(fitting(items, 'LI', 2, 8).map(({ label, start }) => [label, start])).toEqual([
      ['LIMIT', 0],
      ['xLimit', 0],
    ]);
    expect(fitting([item('ET', 12, 12)], 'inst.E', 6, 7)).toEqual([
      { label: 'ET', detail: '', insert: 'ET', start: 5 },
    ]);
  });

  it('are taken by Enter only where something is left to write', () => {
    const proposals = fitting([item('LD', 0, 0), item('LDN', 0, 0)], 'L', 1, 0);
    expect(preselected(proposals, 'L', false)).toBe(0);
    expect(preselected(proposals, 'ld', false)).toBe(-1);
    expect(preselected(proposals, '', false)).toBe(-1);
    expect(preselected(proposals, '', true)).toBe(0);
    expect(preselected([], 'L', true)).toBe(-1);
  });
});

describe('rows and what is known about them', () => {
  it('have the messages of their line, a label those before its instruction', () => {
    const rows = parseRows('m: LD a\nST b');
    const marker = (line: number, column: number, severity: number) => ({
      severity,
      message: `${String(line)}.${String(column)}`,
      startLineNumber: line,
      startColumn: column,
    });
    const found = messagesByRow([marker(1, 1, 4), marker(1, 7, 8), marker(2, 4, 2)], rows);
    expect([...found].map(([row, [first]]) => [row, first?.severity, first?.message])).toEqual([
      [0, 'warning', '1.1'],
      [1, 'error', '1.7'],
      [2, 'info', '2.4'],
    ]);
  });

  it('have the variables they read or write', () => {
    const text = 'm: LD a[i]\nJMPC m\n(* x\ny *)\nCAL t1(\nIN := b,\nQ => c)\nLIMIT d, e';
    const found = usesByRow(text, parseRows(text));
    expect([...found].map(([row, uses]) => [row, uses.map(({ start, end }) => text.slice(start, end))])).toEqual([
      [1, ['a[i]', 'i']],
      [5, ['b']],
      [6, ['c']],
      [7, ['d', 'e']],
    ]);
  });

  it('ask for the declaration of the operand alone', () => {
    const rows = parseRows('ADD a,\nb\nCAL t1(\nIN := x )\nJMP m\nm: LD (c, d)');
    expect(rows.map(operandName)).toEqual(['a', 'b', 't1', 'x', '', '', 'c, d']);
  });

  it('are edited in the columns they have', () => {
    const rows = parseRows('m: LD a\n// c\n{p}\n');
    const columns = ['line', 'operator', 'operand', 'value', 'address', 'symbolComment', 'comment'];
    expect(rows.map((row) => columns.map((column) => editedColumn(row, column)))).toEqual([
      [null, 'operator', 'operator', null, null, null, null],
      [null, 'operator', 'operand', null, null, null, 'comment'],
      [null, 'comment', 'comment', 'comment', 'comment', 'comment', 'comment'],
      [null, 'operator', 'operator', null, null, null, 'comment'],
      [null, 'operator', 'operand', null, null, null, 'comment'],
    ]);
  });
});
