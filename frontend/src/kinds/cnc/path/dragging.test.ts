import { describe, expect, it } from 'vitest';
import { readBlock } from '../line';
import { arcOf, startState, stateAfter, type State } from '../state';
import { movableEnd, movableTangents, rounded, withEnd, withTangent } from './dragging';

function before(...lines: string[]): State {
  return lines.reduce((state, line) => stateAfter(readBlock(line), state), startState());
}

const moved = (line: string, state: State, x: number, y: number, z = 0) => withEnd(readBlock(line), state, [x, y, z]);

describe('an end that is dragged', () => {
  it('changes the words that the line has, and adds those that it needs', () => {
    const state = before('G0 X10 Y0');
    expect(moved('N10 G1 X50 Y0 F100 (side)', state, 60, 5)).toBe('N10 G1 X60 Y5 F100 (side)');
    expect(moved('N10 G1 X50', state, 60, 5)).toBe('N10 G1 X60 Y5');
    expect(moved('N10 G1 X50', state, 60, 0)).toBe('N10 G1 X60');
    expect(moved('G1 X50 Z3', state, 50, 0, 8)).toBe('G1 X50 Z8');
    expect(moved('X50', before('G1 X10'), 20, 0)).toBe('X20');
  });

  it('counts from where the program counts', () => {
    expect(moved('G1 X10', before('G0 X5 Y5', 'G91'), 25, 5)).toBe('G1 X20');
    expect(moved('G1 X10', before('G54 X100 Y5', 'G0 X0 Y0'), 125, 5)).toBe('G1 X25');
  });

  it('is not one where no coordinates are, or where they come from a variable', () => {
    const state = before('G1 X10');
    for (const line of ['M7', 'G41 D5', 'G1 X$GVL.x$', 'G2 I5 J0 T90', '(text)'])
      expect(movableEnd(readBlock(line), state), line).toBeNull();
    expect(movableEnd(readBlock('G1 X5'), before('G1 X$GVL.x$'))).toBeNull();
    // A full circle has no chord that could turn.
    expect(movableEnd(readBlock('G2 X10 Y0 I5 J0'), state)).toBeNull();
  });

  it('leaves an arc the angle that it sweeps', () => {
    for (const modes of [[], ['G98'], ['G91'], ['G54 X3 Y-4', 'G98']])
      for (const line of ['G3 X20 Y10 I0 J10', 'G2 X20 Y10 I10 J0']) {
        const state = before('G1 X10 Y0', ...modes.filter((mode) => !mode.startsWith('G91')));
        const relative = modes.includes('G91') ? { ...state, relative: true } : state;
        const code = Number(line[1]);
        const first = readBlock(placed(line, relative));
        const old = arcOf(first, relative, code)!;
        const next = readBlock(withEnd(first, relative, [40, -12, 0])!);
        const arc = arcOf(next, relative, code)!;
        expect(arc.sweep).toBeCloseTo(old.sweep, 6);
        expect(arc.centre[0] + arc.radius * Math.cos(arc.from + arc.sweep)).toBeCloseTo(40, 6);
        expect(arc.centre[1] + arc.radius * Math.sin(arc.from + arc.sweep)).toBeCloseTo(-12, 6);
      }
  });

  it('turns the axis of an ellipse with it', () => {
    const state = before('G1 X10 Y0');
    expect(moved('G9 X0 Y10 I-10 J0 K0', state, 20, 10)).toBe('G9 X20 Y10 I0 J10 K-90');
  });

  it('makes a radius larger that would not reach', () => {
    const state = before('G1 X0 Y0');
    expect(moved('G3 X10 Y10 R10', state, 10, 0)).toBe('G3 X10 Y0 R10');
    expect(moved('G3 X10 Y10 R10', state, 40, 0)).toBe('G3 X40 Y0 R20.00000002');
  });
});

/** The same arc in the coordinates of a state. */
function placed(line: string, state: State): string {
  const code = line.slice(0, 2);
  const value = (letter: string) => Number(new RegExp(`${letter}(-?\\d+)`).exec(line)![1]);
  const origin = state.relative ? state.position : state.offset;
  const centre = state.centresAbsolute
    ? [state.position[0]! + value('I') - state.offset[0]!, state.position[1]! + value('J') - state.offset[1]!]
    : [value('I'), value('J')];
  const shift = [state.position[0]! - 10, state.position[1]!];
  const end = [value('X') + shift[0]! - origin[0]!, value('Y') + shift[1]! - origin[1]!];
  return `${code} X${String(end[0])} Y${String(end[1])} I${String(centre[0])} J${String(centre[1])}`;
}

describe('a tangent that is dragged', () => {
  const state = before('G1 X10 Y0');

  it('is one of an arc in X/Y', () => {
    expect(movableTangents(readBlock('G3 X20 Y10 R10'), state)).toBe(true);
    expect(movableTangents(readBlock('G1 X20 Y10'), state)).toBe(false);
    expect(movableTangents(readBlock('G3 X20 Y10 R1'), state)).toBe(false);
    expect(movableTangents(readBlock('G3 X20 Y10 R10'), before('G18', 'G1 X10 Y0'))).toBe(false);
  });

  it('gives the arc between the same ends that leaves in its direction', () => {
    expect(withTangent(readBlock('N5 G3 X20 Y10 R10 F5'), state, 'start', [0, 2])).toBe('N5 G2 X20 Y10 I10 J0 F5');
    expect(withTangent(readBlock('G2 X20 Y10 R10'), state, 'start', [3, 0])).toBe('G3 X20 Y10 I0 J10');
    expect(withTangent(readBlock('G3 X20 Y0 R5'), before('G0 X10', 'G98'), 'start', [0, -1])).toBe('G3 X20 Y0 I15 J0');
  });

  it('gives the one that arrives in its direction', () => {
    expect(withTangent(readBlock('G3 X20 Y10 R50'), state, 'end', [0, 1])).toBe('G3 X20 Y10 I0 J10');
  });

  it('cannot lie on the chord', () => {
    expect(withTangent(readBlock('G3 X20 Y10 R10'), state, 'start', [1, 1])).toBeNull();
    expect(withTangent(readBlock('G3 X20 Y10 R10'), state, 'start', [0, 0])).toBeNull();
  });
});

it('a number says no more than a pixel shows', () => {
  expect(rounded(12.3456, 0.2)).toBe(12.3);
  expect(rounded(12.3456, 1.5)).toBe(12);
  expect(rounded(-0.00012345, 0.00001)).toBe(-0.00012);
});
