/** Operations on whole programs (cnc.md CNC-85 to CNC-90, cnc EX-03): relations that hold between the paths before and after. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { findingsOf } from '../checks';
import { curveOf } from '../curve';
import { appliedTo, type LinesEdit } from '../edits';
import { isTravel } from '../gcodes';
import { readBlock } from '../line';
import { ORIGIN, startState, stateAfter, type Position } from '../state';
import { arrayedProgram } from './array';
import { Refused, stepsOf } from './refusal';
import { renumbered } from './renumber';
import { reversedProgram } from './reverse';
import { splitElement } from './split';
import { movedProgram, rotatedProgram, stretchedProgram } from './transform';

type Place = readonly [number, number];
const P = ['N0 G1 X10 Y0 F10', 'N10 G1 X10 Y10', 'N20 G3 X0 Y20 R10'];
const DEFAULTS = { velocity: 100, acceleration: 100, deceleration: 100 };
const AT = (...values: number[]): Position => ORIGIN.map((_, axis) => values[axis] ?? 0);

interface Piece {
  code: number;
  points: Place[];
  others: number[];
  f: number | undefined;
}

/** The pieces of the path, each as nine points of its curve and the places of its other axes at the end. */
function path(lines: readonly string[], start: Position = ORIGIN): Piece[] {
  return stepsOf(lines, start, []).flatMap(({ block, state, after, code }): Piece[] => {
    if (code === null || !isTravel(code) || block.words.every(({ address }) => 'GNFE'.includes(address))) return [];
    const straight = curveOf(readBlock('G1'), state, after, 1)!;
    const curve = curveOf(block, state, after, code) ?? straight;
    return [{ code, points: parts(8).map(curve), others: after.position.slice(2), f: after.rates['F'] }];
  });
}
function parts(count: number): number[] {
  return Array.from({ length: count + 1 }, (_, at) => at / count);
}
function ends(lines: readonly string[], start: Position = ORIGIN): Place[] {
  return path(lines, start).map(
    ({ points }) => points.at(-1)!.map((value) => Number(value.toFixed(6)) + 0) as unknown as Place,
  );
}
function done(lines: readonly string[], edits: readonly LinesEdit[]): string[] {
  return appliedTo(lines, edits);
}
function near(found: readonly Place[], expected: readonly Place[], size = 1) {
  expect(found.length).toBe(expected.length);
  found.forEach(([x, y], at) => {
    expect(Math.abs(x - expected[at]![0])).toBeLessThan(1e-5 * size);
    expect(Math.abs(y - expected[at]![1])).toBeLessThan(1e-5 * size);
  });
}
function reasonOf(act: () => unknown): string {
  try {
    act();
  } catch (error) {
    if (error instanceof Refused) return `${error.reason} ${String(error.line)}`;
    throw error;
  }
  return 'done';
}

const number = fc.integer({ min: -400, max: 400 }).map((value) => value / 8);
const word = (letter: string) =>
  fc.option(
    number.map((value) => ` ${letter}${String(value)}`),
    { nil: '' },
  );
const some = (...letters: string[]) => fc.tuple(...letters.map(word)).map((words) => words.join(''));
const block = fc.oneof(
  { weight: 4, arbitrary: some('X', 'Y', 'Z', 'P').map((words) => `G1${words === '' ? ' X1' : words}`) },
  some('X', 'Y').map((words) => `G0${words === '' ? ' Y2' : words}`),
  fc
    .tuple(fc.constantFrom(2, 3), number, number, fc.integer({ min: 200, max: 900 }))
    .map(([g, x, y, r]) => `G${String(g)} X${String(x)} Y${String(y)} R${String(r)}`),
  fc
    .tuple(fc.constantFrom(2, 3), fc.integer({ min: 1, max: 40 }), number, fc.integer({ min: 10, max: 700 }))
    .map(([g, i, j, t]) => `G${String(g)} I${String(i)} J${String(j)} T${String(t)}`),
  fc
    .tuple(
      fc.constantFrom(8, 9),
      number,
      number,
      fc.integer({ min: 1, max: 40 }),
      number,
      fc.integer({ min: -90, max: 90 }),
    )
    .map(
      ([g, x, y, i, j, k]) =>
        `G${String(g)} X${String(x)} Y${String(y)} I${String(i)} J${String(j)} K${String(k)} R0.5`,
    ),
  fc
    .tuple(number, number, number, number)
    .map(([x, y, i, j]) => `G6 X${String(x)} Y${String(y)} I${String(i)} J${String(j)}`),
  fc.constantFrom('G90', 'G91', 'G98', 'G99', 'G53', 'G40', 'G51 D2', 'G50', 'F50', '(note)', '', 'M7 K1'),
  some('X', 'Y', 'Z').map((words) => `G54${words}`),
  some('X', 'Y').map((words) => `G55${words}`),
  some('X', 'Y', 'P').map((words) => `G56${words}`),
  some('X', 'Y').map((words) => `G92${words}`),
);
const programs = fc.array(block, { maxLength: 14 }).map((lines) => ['G1 X1 Y2 F20', ...lines]);
const starts = fc.tuple(number, number).map(([x, y]) => AT(x, y));

describe('CNC-85 renumber', () => {
  it('cnc EX-03 numbers 0, 10, 20, 30 after a block without number was inserted', () => {
    const lines = [P[0]!, 'G1 X10 Y5', P[1]!, P[2]!];
    expect(done(lines, renumbered(lines))).toEqual([
      'N0 G1 X10 Y0 F10',
      'N10 G1 X10 Y5',
      'N20 G1 X10 Y10',
      'N30 G3 X0 Y20 R10',
    ]);
  });
  it('corrects the targets of jumps, and leaves comments, empty lines and H alone', () => {
    const lines = ['% name', 'N7 G36 D4', '(loop)', '', 'N3 G1 X5 H1 L3', '/G37 D-1', 'N9 G20 L3 K1'];
    expect(done(lines, renumbered(lines))).toEqual([
      '% name',
      'N0 G36 D4',
      '(loop)',
      '',
      'N10 G1 X5 H1 L3',
      '/N20 G37 D-1',
      'N30 G20 L10 K1',
    ]);
  });
});

describe('CNC-86 move', () => {
  it('cnc EX-03 inserts a positioning and moves the ends', () => {
    const lines = done(P, movedProgram(P, ORIGIN, AT(5), 100));
    expect(lines[0]).toBe('G0 X5 Y0');
    expect(ends(lines)).toEqual([
      [5, 0],
      [15, 0],
      [15, 10],
      [5, 20],
    ]);
  });
  it('moves each point of any program by the vector', () => {
    fc.assert(
      fc.property(programs, starts, number, number, number, (lines, start, x, y, p) => {
        const after = done(lines, movedProgram(lines, start, AT(x, y, 0, 0, 0, 0, p), 100));
        const [positioning, ...moved] = path(after, start);
        const before = path(lines, start);
        near(positioning!.points.slice(-1), [[before[0]!.points[0]![0] + x, before[0]!.points[0]![1] + y]]);
        moved.forEach((piece, at) => {
          near(
            piece.points,
            before[at]!.points.map(([a, b]): Place => [a + x, b + y]),
          );
          expect(piece.others[4]).toBeCloseTo(before[at]!.others[4]! + p);
        });
        expect(moved.length).toBe(before.length);
      }),
    );
  });
  it('is refused with A, B, C and with variables', () => {
    expect(reasonOf(() => movedProgram(['G1 X1', 'G1 A5'], ORIGIN, AT(1), 1))).toBe('orientation 2');
    expect(reasonOf(() => movedProgram(['G1 X$v$'], ORIGIN, AT(1), 1))).toBe('variables 1');
    expect(reasonOf(() => movedProgram(['', 'G77'], ORIGIN, AT(1), 1))).toBe('faulty 2');
  });
  it('gives the positioning a velocity where none would hold', () => {
    expect(done(P, movedProgram(P, ORIGIN, AT(5), 0))[0]).toBe('G0 X5 Y0 F10');
  });
});

describe('CNC-87 rotate', () => {
  it('cnc EX-03 by 90 degrees', () => {
    expect(ends(done(P, rotatedProgram(P, ORIGIN, 90)))).toEqual([
      [0, 10],
      [-10, 10],
      [-20, 0],
    ]);
  });
  it('turns each point of any program around the origin', () => {
    fc.assert(
      fc.property(programs, starts, fc.oneof(fc.constantFrom(90, 180, -90, 360), number), (lines, start, degrees) => {
        const angle = (degrees * Math.PI) / 180;
        const turn = ([x, y]: Place): Place => [
          x * Math.cos(angle) - y * Math.sin(angle),
          x * Math.sin(angle) + y * Math.cos(angle),
        ];
        const after = path(done(lines, rotatedProgram(lines, start, degrees)), start);
        const before = path(lines, start);
        expect(after.map(({ code }) => code)).toEqual(before.map(({ code }) => code));
        after.forEach((piece, at) => near(piece.points, before[at]!.points.map(turn), 10));
      }),
    );
  });
  it('is refused with variables, jumps and elements in planes through Z', () => {
    expect(reasonOf(() => rotatedProgram(['G1 X$v$'], ORIGIN, 1))).toBe('variables 1');
    expect(reasonOf(() => rotatedProgram(['N0 G1 X1', 'G20 L0'], ORIGIN, 1))).toBe('jumps 2');
    expect(reasonOf(() => rotatedProgram(['G18'], ORIGIN, 1))).toBe('plane 1');
  });
});

describe('CNC-88 stretch', () => {
  it('cnc EX-03 by 2', () => {
    const lines = done(P, stretchedProgram(P, ORIGIN, 2, false));
    expect(lines).toEqual(['N0 G1 X20 Y0 F10', 'N10 G1 X20 Y20', 'N20 G3 X0 Y40 R20']);
  });
  it('multiplies each point of any program; a negative factor mirrors through the origin', () => {
    fc.assert(
      fc.property(programs, starts, fc.constantFrom(2, 0.5, -1, -3), (lines, start, factor) => {
        const after = path(done(lines, stretchedProgram(lines, start, factor, true)), start);
        const before = path(lines, start);
        expect(after.length).toBe(before.length);
        after.forEach((piece, at) => {
          near(
            piece.points,
            before[at]!.points.map(([x, y]): Place => [x * factor, y * factor]),
            10,
          );
          expect(piece.f).toBe(before[at]!.f);
        });
      }),
    );
  });
  it('stretches distances of switch points, and D where it is asked to', () => {
    const lines = ['G41 D5', 'G1 X10 H1 L2 H-1 O0.5'];
    expect(done(lines, stretchedProgram(lines, ORIGIN, -2, true))).toEqual(['G41 D10', 'G1 X-20 H1 L4 H-1 O0.5']);
    expect(done(lines, stretchedProgram(lines, ORIGIN, 2, false))[0]).toBe('G41 D5');
  });
});

describe('CNC-89 reverse', () => {
  it('cnc EX-03 begins at the end and turns arcs', () => {
    expect(done(P, reversedProgram(P, ORIGIN, DEFAULTS))).toEqual([
      'N0 G92 X0 Y20',
      'N10 G2 X10 Y10 R10 F10',
      'N20 G1 X10 Y0',
      'N30 G1 X0 Y0',
    ]);
  });
  it('passes each point of any program the other way, as fast as before', () => {
    fc.assert(
      fc.property(programs, starts, (lines, start) => {
        const before = path(lines, start);
        const after = path(done(lines, reversedProgram(lines, start, DEFAULTS)), start);
        expect(after.length).toBe(before.length);
        after.reverse().forEach((piece, at) => {
          near(piece.points, [...before[at]!.points].reverse());
          expect(piece.f).toBe(before[at]!.f);
        });
      }),
    );
  });
  it('keeps ranges around the same elements, correction on the other side', () => {
    const lines = ['G1 X1 F10', 'G41 D5', 'G51 D2', 'G1 X2', 'G50', 'G1 X3', 'G40', 'G1 X4'];
    expect(done(lines, reversedProgram(lines, ORIGIN, DEFAULTS)).map((text) => text.replace(/^N\d+ /, ''))).toEqual([
      ...['G92 X4 Y0', 'G1 X3 Y0 F10', 'G42 D5', 'G1 X2 Y0', 'G51 D2', 'G1 X1 Y0', 'G50', 'G40', 'G1 X0 Y0'],
    ]);
  });
  it('puts switch points where they were', () => {
    const lines = ['G1 X100 H2 L20 H-2 L-10 H3 O0.25 F9'];
    expect(done(lines, reversedProgram(lines, ORIGIN, DEFAULTS))[1]).toBe('N10 G1 X0 Y0 F9 H-2 L-20 H2 L10 H-3 O0.75');
  });
  it('is refused with A, B, C, variables, step suppression and jumps, and where F cannot be taken back', () => {
    for (const [line, reason] of [
      ['G1 A1', 'orientation'],
      ['G1 X$v$', 'variables'],
      ['/G1 X1', 'suppression'],
      ['G20 L0', 'jumps'],
    ] as const)
      expect(reasonOf(() => reversedProgram(['N0 G1 X1', line], ORIGIN, DEFAULTS))).toBe(`${reason} 2`);
    const late = ['G1 X1', 'G1 X2 F10'];
    expect(reasonOf(() => reversedProgram(late, ORIGIN, { ...DEFAULTS, velocity: 0 }))).toBe('unset 1');
    expect(done(late, reversedProgram(late, ORIGIN, DEFAULTS))[2]).toBe('N20 G1 X0 Y0 F100');
  });
});

describe('CNC-90 split', () => {
  it('a line, an arc by its radius and one by its centre', () => {
    expect(done(['N0 G1 X10 Y4 F10 (to there)'], splitElement(['N0 G1 X10 Y4 F10 (to there)'], ORIGIN, 0))).toEqual([
      'N0 G1 X5 Y2 F10',
      'G1 X10 Y4 (to there)',
    ]);
    expect(splitElement(['G2 X20 Y0 R10'], ORIGIN, 0)[0]!.lines).toEqual(['G2 X10 Y10 R10', 'G2 X20 Y0 R10']);
    expect(splitElement(['G2 X20 Y0 I10 J0'], ORIGIN, 0)[0]!.lines).toEqual(['G2 X10 Y10 I10 J0', 'G2 X20 Y0 I0 J-10']);
  });
  it('keeps every point of any element, and its other axes', () => {
    fc.assert(
      fc.property(programs, starts, fc.nat(20), (lines, start, at) => {
        const line = at % lines.length;
        const [step] = stepsOf(lines, start, []).slice(line);
        const isPiece = path(lines.slice(0, line + 1), start).length > path(lines.slice(0, line), start).length;
        const state = step!.state;
        fc.pre(isPiece && curveOf(step!.block, state, step!.after, step!.code!) !== null);
        const before = path(lines, start);
        const index = path(lines.slice(0, line), start).length;
        const after = path(done(lines, splitElement(lines, start, line)), start);
        expect(after.length).toBe(before.length + 1);
        const [first, second] = after.splice(index, 2, before[index]!);
        const whole = curveOf(step!.block, state, step!.after, step!.code!)!;
        near(
          first!.points,
          parts(8).map((part) => whole(part / 2)),
          10,
        );
        near(
          second!.points,
          parts(8).map((part) => whole(0.5 + part / 2)),
          10,
        );
        after.forEach((piece, number_) => near(piece.points, before[number_]!.points, 10));
      }),
    );
  });
  it('leaves switch points where they were', () => {
    expect(splitElement(['G1 X100 H1 L20 H2 O0.75 H-3 L-10'], ORIGIN, 0)[0]!.lines).toEqual([
      'G1 X50 H1 L20',
      'G1 X100 H2 O0.5 H-3 L-10',
    ]);
  });
  it('is refused where there is no middle', () => {
    const lines = ['G90', 'G5 X1 Y1', 'G2 X9 Y1 R1', ''];
    expect([0, 1, 2, 3].map((line) => reasonOf(() => splitElement(lines, ORIGIN, line)))).toEqual([
      'element 1',
      'spline 2',
      'shape 3',
      'element 4',
    ]);
  });
});

describe('arrays', () => {
  it('repeat the path at each place of the grid', () => {
    fc.assert(
      fc.property(
        programs,
        starts,
        fc.integer({ min: 1, max: 3 }),
        fc.integer({ min: 1, max: 3 }),
        (lines, start, columns, rows) => {
          const copies = done(lines, arrayedProgram(lines, start, { columns, rows, dx: 30, dy: -7 }, 100));
          const before = path(lines, start);
          const after = path(copies, start);
          expect(after.length).toBe(before.length * columns * rows + columns * rows - 1);
          for (let copy = 0; copy < columns * rows; copy++) {
            const [dx, dy] = [(copy % columns) * 30, Math.floor(copy / columns) * -7];
            const part = after.slice(copy * (before.length + 1), copy * (before.length + 1) + before.length);
            part.forEach((piece, at) =>
              near(
                piece.points,
                before[at]!.points.map(([x, y]): Place => [x + dx, y + dy]),
                10,
              ),
            );
          }
        },
      ),
    );
  });
});

describe('programs after an operation', () => {
  it('have no errors where there were none', () => {
    fc.assert(
      fc.property(programs, (lines) => {
        for (const edits of [
          movedProgram(lines, ORIGIN, AT(1, 2), 100),
          rotatedProgram(lines, ORIGIN, 30),
          stretchedProgram(lines, ORIGIN, -2, true),
          reversedProgram(lines, ORIGIN, DEFAULTS),
          renumbered(lines),
        ]) {
          let state = startState(ORIGIN);
          for (const text of done(lines, edits)) {
            const found = findingsOf(readBlock(text), state, { velocity: 1, ready: false, suppress: false });
            expect(
              found.filter(({ severity }) => severity === 'error'),
              text,
            ).toEqual([]);
            state = stateAfter(readBlock(text), state);
          }
        }
      }),
    );
  });
});
