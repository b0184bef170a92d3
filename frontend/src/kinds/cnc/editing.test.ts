/** What text and table editor make of a program: fixes, folds, hovers, proposals, cells (cnc.md sections 2 and 3). */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { proposalsAt } from './completion';
import { appliedTo, changeOf, cutOut, withWord, type LinesEdit } from './edits';
import { fixesOf, likelyCodes } from './fixes';
import { foldsOf } from './folding';
import { readBlock } from './line';
import { explained, inForce, positionText } from './meaning';
import { CncProgram, linesOf } from './program';
import { ORIGIN, startState, stateAfter } from './state';
import {
  appended,
  appliedToAll,
  cellFault,
  cellOf,
  isAvailable,
  moved,
  newElement,
  rowOf,
  typeOf,
  withCell,
  withType,
} from './table';
import { usedVariables } from './variables';

function checked(text: string): CncProgram {
  const made = new CncProgram(linesOf(text), { velocity: 1, ready: false, suppress: false }, ORIGIN);
  while (!made.check(100));
  return made;
}
/** The texts that the fixes lead to. */
function fixed(text: string): string[] {
  const program = checked(text);
  const fixes = program.findings().flatMap((found) => fixesOf(program, found));
  return fixes.map(({ edits }) => appliedTo(text.split('\n'), edits).join('\n'));
}
const row = (text: string, before = '') => rowOf(readBlock(text), stateAfter(readBlock(before), startState(ORIGIN)));

describe('quick fixes', () => {
  it.each([
    ['G11 X1', 'G1 X1'],
    ['GO1 X5', 'G1 X5'],
    ['G1.4 X1', 'G1 X1'],
    ['G1 X 10', 'G1 X10'],
    ['G1 X10,5', 'G1 X10.5'],
    ['G4 T1 X5', 'G4 T1'],
    ['X5 Y5', 'G1 X5 Y5'],
    ['G1 X5 (open', 'G1 X5 (open)'],
    ['G90 G1 X5', 'G90\nG1 X5'],
    ['G1 X5 H1', 'G1 X5 H1 O0.5'],
    ['N10 G1 X1\nN10 G1 X2', 'N10 G1 X1\nN20 G1 X2'],
    ['N10 G1 X1\nG20 L11', 'N10 G1 X1\nG20 L10'],
  ])('CNC-37 %s becomes %s', (text, expected) => {
    expect(fixed(text)).toContain(expected);
  });
  it('propose the codes that look like what was written', () => {
    expect(likelyCodes('77')).toEqual([17, 37, 70]);
    expect(likelyCodes('12345')).toEqual([]);
  });
});

describe('folds', () => {
  it('are sections under comments and ranges of the modes', () => {
    const text = '(first)\nG1 X1\nG41 D5\nG1 X2\nG40\n(second)\n(more)\nG61\nG1 X3\nG60\n';
    expect(foldsOf(text)).toEqual([
      { start: 0, end: 4 },
      { start: 2, end: 4 },
      { start: 5, end: 9 },
      { start: 7, end: 9 },
    ]);
  });
  it('are subprograms, and nothing in words of comments', () => {
    expect(foldsOf('SUBPROGRAM ARCS{#R : LREAL}\nG91\nEND_SUBPROGRAM')).toEqual([{ start: 0, end: 2 }]);
    expect(foldsOf('G1 X1 (G41 here)\nG1 X2\nG1 (G40)')).toEqual([]);
  });
});

describe('hovers', () => {
  it('CNC-30 say what a word means beside its command', () => {
    const about = (text: string, at: number, before = '') =>
      explained(readBlock(text), at, stateAfter(readBlock(before), startState(ORIGIN)))?.about;
    expect(about('G20 L10 K1', 4)).toBe('Block number that the jump leads to');
    expect(about('M7 K1 L2', 6)).toBe('Second parameter of the M function');
    expect(about('G8 X1 I1 J0 K45', 12)).toBe('Direction of the main axis [°]');
    expect(about('G2 I5 J0 K180', 9)).toBe('Opening angle [°]');
    expect(about('G1 X5', 3)).toBe('Target position of axis X');
    expect(about('G1 X5', 3, 'G91')).toBe('Distance of axis X (G91)');
    expect(about('G41 D5', 4)).toBe('Tool radius');
    expect(about('G1 X5', 0)).toBe('Straight line with tool contact');
    expect(about('G1 X5', 2)).toBeUndefined();
  });
  it('GC-12 name what is in force and where the axes are', () => {
    const state = ['G91', 'G1 X5 Z2 F10 E-3', 'G51 D2'].reduce(
      (now, text) => stateAfter(readBlock(text), now),
      startState(ORIGIN),
    );
    expect(inForce(state)).toBe('G1 G91 G99 G51 D2 F10 E-3');
    expect(positionText(state)).toBe('X5 Y0 Z2');
  });
});

describe('proposals', () => {
  const labels = (text: string, at = text.length, variables: string[] = []) =>
    proposalsAt(readBlock(text), at, startState(ORIGIN), variables).proposals.map(({ label }) => label);
  it('CNC-34 are variables behind a dollar sign', () => {
    expect(labels('G1 X$', 5, ['GVL.rX'])).toEqual(['$GVL.rX$']);
    expect(labels('G1 X$a$ Y', 9, ['GVL.rX'])).not.toContain('$GVL.rX$');
  });
  it('are commands, then the letters that a command takes and that are not there', () => {
    expect(labels('')).toEqual(expect.arrayContaining(['G0', 'G1', 'G92', 'X', 'F']));
    expect(labels('G4 ')).toEqual(['T']);
    expect(labels('G2 X1 ')).toEqual(expect.arrayContaining(['Y', 'R', 'I', 'T']));
    expect(labels('G2 X1 ')).not.toContain('X');
    expect(labels('G31')).toContain('G31');
    expect(labels('G32')).not.toContain('G32');
    expect(labels('(note')).toEqual([]);
  });
});

describe('cells', () => {
  it('CNC-42 are there where the type has the value', () => {
    expect(isAvailable(row('G1 X1'), 'r')).toBe(false);
    expect(isAvailable(row('G2 X1 R5'), 'r')).toBe(true);
    expect(isAvailable(row('(note)'), 'x')).toBe(false);
    expect(isAvailable(row('(note)'), 'comment')).toBe(true);
  });
  it('CNC-40 show what the block says, and muted what holds from before', () => {
    expect(cellOf(row('G1 X1.50'), 'x')).toEqual({ text: '1.50', modal: false });
    expect(cellOf(row('G1 X1', 'G1 Y7 F20'), 'y')).toEqual({ text: '7', modal: true });
    expect(cellOf(row('G1 X1', 'G1 Y7 F20'), 'f')).toEqual({ text: '20', modal: true });
    expect(cellOf(row('G1 X1 E10 E-20'), 'deceleration')).toEqual({ text: '-20', modal: false });
  });
  it('CNC-47 are locked where the table has no element', () => {
    expect(
      ['G6 X1 I1 J1', 'G1 X$v$', 'G20 L1', 'G54 X1', '/G1 X1', 'G4 T1', 'G75'].map((text) => row(text).textOnly),
    ).toEqual(Array(7).fill(true));
    expect(['G1 X1', 'G92 X1', 'M7', 'G51 D1', 'F10', '(note)', ''].map((text) => row(text).textOnly)).toEqual(
      Array(7).fill(false),
    );
  });
  it('CNC-44 take numbers with a decimal point, and nothing else', () => {
    expect(withCell(readBlock('N0 G1 X1 (a)'), 'x', '2,5')).toBe('N0 G1 X2.5 (a)');
    expect(withCell(readBlock('N0 G1 X1 (a)'), 'y', '3')).toBe('N0 G1 X1 Y3 (a)');
    expect(withCell(readBlock('N0 G1 X1 Y2'), 'x', '')).toBe('N0 G1 Y2');
    expect(withCell(readBlock('G1 X1 E10'), 'deceleration', '5')).toBe('G1 X1 E10 E-5');
    expect(withCell(readBlock('G1 X1'), 'comment', 'hole')).toBe('G1 X1 (hole)');
    expect([cellFault('x', '1a'), cellFault('n', '1.5'), cellFault('comment', ')'), cellFault('x', '-1e3')]).toEqual([
      ...['cnc.number', 'cnc.wholeNumber', 'cnc.noClosing', null],
    ]);
  });
  it('CNC-43 new elements have the values of the one before, and a number between', () => {
    expect(newElement(readBlock('N10 G1 X5 F9'), readBlock('N20 G1 X6'))).toBe('N15 G1 X5 F9');
    expect(newElement(readBlock('N10 G1 X5'), undefined)).toBe('N20 G1 X5');
    expect(newElement(readBlock('N10 G1 X5'), readBlock('N11 G1'))).toBe('G1 X5');
    expect(newElement(undefined, undefined)).toBe('G1 X0 Y0');
    expect(appliedTo(['G1 X1', ''], [appended(2, '', 'G1 X2')])).toEqual(['G1 X1', 'G1 X2', '']);
    expect(appliedTo(['G1 X1'], [appended(1, 'G1 X1', 'G1 X2')])).toEqual(['G1 X1', 'G1 X2']);
  });
  it('types keep the words that the other type has', () => {
    expect(withType(readBlock('N0 G2 X1 R5 F3'), 'G1')).toBe('N0 G1 X1 F3');
    expect(withType(readBlock('N0 X1'), 'G3')).toBe('N0 G3 X1');
    expect(withType(readBlock('N0 G1 X1'), 'M')).toBe('N0 M1');
    expect(typeOf(row('X5', 'G3 X1 R2'))).toEqual({ text: 'G3' });
  });
  it('CNC-45 apply a value to all rows where it is possible', () => {
    const lines = ['G1 X1', '(note)', 'G2 X2 R1 F5', 'G4 T1', 'M7'];
    const rows = lines.map((text) => row(text));
    expect(appliedTo(lines, appliedToAll(rows, 'f', '9'))).toEqual([
      'G1 X1 F9',
      '(note)',
      'G2 X2 R1 F9',
      'G4 T1',
      'M7',
    ]);
  });
  it('rows move by one among their neighbours', () => {
    const lines = ['a', 'b', 'c', ''];
    expect(appliedTo(lines, [moved(lines, 1, 2, -1, 3)!])).toEqual(['b', 'c', 'a', '']);
    expect(appliedTo(lines, [moved(lines, 0, 0, 1, 3)!])).toEqual(['b', 'a', 'c', '']);
    expect([moved(lines, 0, 0, -1, 3), moved(lines, 2, 2, 1, 3)]).toEqual([null, null]);
  });
});

describe('edits', () => {
  it('of characters make the same text as edits of lines', () => {
    const lines = fc.array(fc.string({ unit: fc.constantFrom('X', '1', ' ') }), { minLength: 1, maxLength: 6 });
    fc.assert(
      fc.property(
        lines,
        fc.nat(6),
        fc.nat(6),
        fc.array(fc.constantFrom('X1', '', 'Y'), { maxLength: 4 }),
        (before, at, count, after) => {
          const from = Math.min(at, before.length);
          const removed = Math.min(count, before.length - from);
          const edit: LinesEdit = { from, removed, lines: after };
          const expected = appliedTo(before, [edit]).join('\n');
          const text = before.join('\n');
          const place = { first: from === 0, last: from + removed >= before.length };
          const change = changeOf(before.slice(from, from + removed), after, place);
          if (change === null) {
            expect(text).toBe(expected);
            return;
          }
          const start = before.slice(0, from).join('\n').length + (from > 0 && !change.breakBefore ? 1 : 0);
          expect(text.slice(0, start + change.start) + change.text + text.slice(start + change.end)).toBe(expected);
        },
      ),
    );
  });
  it('keep words apart and take one blank along', () => {
    expect(withWord(readBlock('N10G1X5'), 'Y', '2')).toBe('N10G1X5 Y2');
    expect(withWord(readBlock('G1X5F3'), 'Y', '2')).toBe('G1X5 Y2 F3');
    expect(withWord(readBlock('/X5'), 'N', '0')).toBe('/N0 X5');
    expect(cutOut('G1 X5 Y6', 3, 5)).toBe('G1 Y6');
    expect(cutOut('G1 X5', 3, 5)).toBe('G1');
  });
});

describe('variables', () => {
  it('CNC-17 VAR-01 are named once, in the order of their use', () => {
    expect(usedVariables(['G1 X$GVL.a$ Y$b$', 'F$gvl.A$', 'X$1$'], ['c', 'B'])).toEqual(['GVL.a', 'b', 'c']);
  });
});
