/** CNC programs as lines: reading (GC-01 to GC-13), states, and checks that cost what an edit touches. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { findingsOf, type Conditions, type Rule } from './checks';
import { commentOf, numberWord, readBlock, valueOf } from './line';
import { CncProgram, linesOf } from './program';
import { ORIGIN, startState, stateAfter, type State } from './state';

const PLAIN: Conditions = { velocity: 100, ready: false, suppress: false };

function program(text: string, conditions: Partial<Conditions> = {}): CncProgram {
  const made = new CncProgram(linesOf(text), { ...PLAIN, ...conditions }, ORIGIN);
  while (!made.check(7));
  return made;
}
function rules(text: string, conditions: Partial<Conditions> = {}): Rule[] {
  return program(text, conditions)
    .findings()
    .map(({ rule }) => rule);
}
function behind(text: string): State {
  const made = program(text);
  return made.stateBefore(made.count);
}
function end(text: string): number[] {
  return behind(text)
    .position.slice(0, 2)
    .map((value) => Number(value.toFixed(6)));
}

/** Lines as people write them, right and wrong. */
const words = fc.oneof(
  fc.tuple(fc.constantFrom('N', 'G', 'M', 'H'), fc.nat(100)).map(([letter, value]) => `${letter}${String(value)}`),
  fc
    .tuple(fc.constantFrom(...'XYZIJKRFEDLOTS', 'FZ', 'EF', 'x'), fc.double({ min: -1e3, max: 1e3, noNaN: true }))
    .map(([letter, value]) => `${letter}${value.toFixed(3)}`),
  fc.constantFrom(
    'X$GVL.rX$',
    '(note)',
    '// to the end',
    '/',
    '%CNC',
    'X',
    '#a',
    '{1+2}',
    'G1.',
    'LET #x',
    '?',
    '(open',
  ),
);
const line = fc.array(words, { maxLength: 7 }).map((all) => all.join(' '));
const anyLine = fc.oneof(
  { weight: 3, arbitrary: line },
  fc.string({ unit: 'grapheme' }).map((text) => text.replace(/\n/g, '')),
);

describe('a block', () => {
  it('GC-01 is made up of its tokens, byte by byte', () => {
    fc.assert(
      fc.property(anyLine, (text) => {
        const { tokens } = readBlock(text);
        expect(tokens.map(({ at, end }) => text.slice(at, end)).join('')).toBe(text);
        expect(tokens.every(({ at, end: last }) => last > at)).toBe(true);
        expect(tokens.every(({ at }, index) => at === (tokens[index - 1]?.end ?? 0))).toBe(true);
      }),
    );
  });
  it('GC-03 has letters in either case, leading zeros, exponents, variables, and needs no blanks', () => {
    const block = readBlock('n010g01X1.5y-.5Z1e2P$GVL.rP$');
    expect(block.words.map(({ address }) => address)).toEqual(['N', 'G', 'X', 'Y', 'Z', 'P']);
    expect(block.number).toBe(10);
    expect(['G', 'X', 'Y', 'Z', 'P', 'Q'].map((letter) => valueOf(block, letter))).toEqual([
      1,
      1.5,
      -0.5,
      100,
      NaN,
      undefined,
    ]);
    expect(block.words.at(-1)!.value).toEqual({ kind: 'variable', name: 'GVL.rP' });
  });
  it('GC-09 GC-10 GC-13 has comments anywhere, and a mark of step suppression at its beginning', () => {
    const block = readBlock('/N10 (to the hole) G1 X5 // fast');
    expect([block.skip, block.number, commentOf(block)]).toEqual([true, 10, 'to the hole fast']);
    expect(readBlock('').tokens).toEqual([]);
    expect(readBlock('% Part (7)').tokens.map(({ kind }) => kind)).toEqual(['header']);
  });
  it('reads addresses of several letters', () => {
    const addresses = readBlock('G1 FZ10 EZ5 FF20 EF7 E10 E-5 PROBE1').words.map(({ address }) => address);
    expect(addresses).toEqual(['G', 'FZ', 'EZ', 'FF', 'EF', 'E', 'E', 'PROBE']);
  });
  it('writes numbers without exponent and without an end of zeros', () => {
    expect([0, -0, 1, 0.1 + 0.2, 1e-12, -2.5, 1e7].map(numberWord)).toEqual([
      '0',
      '0',
      '1',
      '0.3',
      '0',
      '-2.5',
      '10000000',
    ]);
  });
});

describe('the state', () => {
  it('cnc EX-17 absolute and relative coordinates', () => {
    expect(end('N0 G91\nN10 G1 X10 Y10 F100\nN20 G1 X100')).toEqual([110, 10]);
    expect(end('N0 G90\nN10 G1 X10 Y10 F100\nN20 G1 X100')).toEqual([100, 10]);
  });
  it('GC-06 coordinates without a command go on with the travel command before', () => {
    expect(end('G1 X10\nX20 Y5\nG4 T1\nY7')).toEqual([20, 7]);
    expect(behind('G1 X10\nG90\nX20').travel).toBe(1);
  });
  it('cnc EX-24 GEO-21 coordinate shifts', () => {
    expect(end('G54 X10 Y5\nG1 X10 Y0')).toEqual([20, 5]);
    expect(end('G54 X10 Y5\nG1 X10 Y0\nG55 X1\nG1 X10 Y0')).toEqual([21, 5]);
    expect(end('G54 X10 Y5\nG1 X10 Y0\nG53\nG1 X10 Y0')).toEqual([10, 0]);
    expect(end('G1 X10 Y0\nG56 X0 Y0\nG1 X5 Y5')).toEqual([15, 5]);
  });
  it('cnc EX-16 GEO-07 arcs by opening angle end where the angle ends', () => {
    expect(end('G1 X100 Y100\nG2 I50 J0 T180')).toEqual([200, 100]);
    expect(end('G1 X100 Y100\nG2 I50 J0 K180')).toEqual([200, 100]);
    expect(end('G1 X100 Y100\nG2 I50 J0 T720')).toEqual([100, 100]);
    expect(end('G1 X100 Y100\nG3 I50 J0 T90')).toEqual([150, 50]);
  });
  it('GC-12 F, E and E- hold until another one is given', () => {
    expect(behind('G1 X10 F10 E20 E-30\nX20\nF15').rates).toEqual({ F: 15, E: 20, 'E-': 30 });
  });
  it('cnc EX-30 GC-10 blocks that are suppressed change nothing', () => {
    const text = 'N0 G1 X10 F10\n/N10 G1 Y10\nN20 G1 X20';
    const suppressed = program(text, { suppress: true });
    expect(suppressed.stateBefore(3).position.slice(0, 2)).toEqual([20, 0]);
    expect(end(text)).toEqual([20, 10]);
  });
});

describe('messages', () => {
  it.each<[string, string, Rule[]]>([
    ['cnc EX-32 GC-08', 'N0 G77 X1', ['unknownCode']],
    ['cnc EX-32 CNC-37', 'N0 G1 X', ['missingValue']],
    ['cnc EX-32', 'N0 G20 L999 K1', ['noTarget']],
    ['GC-06', 'N0 X10 Y5', ['noTravel']],
    ['GC-08', 'N0 G90 G1 X10', ['twoCommands', 'notTaken']],
    ['CNC-37', 'N0 G1 X10 ?', ['noWord']],
    ['GC-09', 'N0 G1 X10 (open', ['openComment']],
    ['GC-04', 'N0 G1.5 X10', ['whole']],
    ['GC-04 H', 'G1 X10 H1.5 O0.5', ['whole']],
    ['letters of G4', 'G4 T1 X5', ['notTaken']],
    ['partner words', 'G4', ['needs']],
    ['partner words of an arc', 'G2 X10', ['needsCentre']],
    ['GC-05', 'G1 X10 X20', ['twice']],
    ['GC-05 E', 'G1 X10 E10 E-10', []],
    ['GC-05 E twice', 'G1 X10 E10 E20', ['twice']],
    ['H at most three', 'G1 X9 H1 O0.1 H2 O0.2 H3 O0.3 H4 O0.4', ['manySwitches']],
    ['H without place', 'G1 X9 H1', ['switchPlace']],
    ['L without H', 'G1 X9 L1', ['switchPlace']],
    ['cnc EX-19', 'N0 G1 X20\nN10 G1 X100 H2 L20 H-2 L-10', []],
    ['a probe of a movement that has none', 'G0 X10 PROBE1', ['notTaken']],
    ['a number of a probe', 'G1 X10 PROBE0', ['probe']],
    ['a probe and a switch point', 'G1 X10 H1 L2 PROBE1', ['probeSwitch']],
    ['no axis', 'G71 L3', ['numberRange']],
    ['VAR-05', 'LET #x : LREAL := 3', ['extension']],
    ['GC-02', 'G1 N10 X5', ['blockNumber']],
    ['GC-02 twice', 'N10 G1 X5\nN10 G1 X6', ['sameNumber']],
    ['GEO-05 cnc EX-16 (g)', 'G1 X100 Y100\nG2 X200 Y100 R40', ['noArc']],
    ['GEO-06', 'G2 X10 Y0 I3 J0', ['noArc']],
    ['GEO-07', 'G2 I5 J0 T1081', ['openingAngle']],
    ['cnc EX-28', 'N0 G1 X50 F100\nN10 M7 K1.5 L2\nN20 G1 X100', []],
    ['letters of M', 'M7 X1', ['notTaken']],
    ['cnc EX-18', 'N00 G36 D4\nN10 G91\nN20 G1 X5 Y0 F100\nN30 G37 D-1\nN40 G20 L20', []],
    ['cnc EX-12', 'N000 G01 X10 Y0 F100\nN010 G51 D2 (smooth corners)\nN020 G01 X10 Y20\nN050 G50\n', []],
    ['a letter that there is none', 'G1 X1\nV5 D1 Y3', []],
  ])('%s: %s', (_, text, expected) => {
    expect(rules(text)).toEqual(expected);
  });
  it('CNC-13 cnc EX-32 says that an element has no velocity', () => {
    expect(rules('N0 G1 X10', { velocity: 0 })).toEqual(['noVelocity']);
    expect(rules('N0 G1 X10 F5\nX20\nG0 X3', { velocity: 0 })).toEqual([]);
    expect(rules('F5\nG1 X10', { velocity: 0 })).toEqual([]);
    expect(rules('G0 X10 FF20', { velocity: 0 })).toEqual([]);
  });
  it('CNC-35 VAR-02 warns of variables where a queue is made at compile time', () => {
    expect(rules('G1 X$GVL.x$')).toEqual([]);
    expect(rules('G1 X$GVL.x$', { ready: true })).toEqual(['variables']);
  });
  it('CNC-37 stand where the fault is', () => {
    const [found] = program('N0 G0 X0\nN10  G77 X1').findings();
    expect([found!.line, found!.at, found!.end]).toEqual([1, 5, 8]);
  });
  it('are at most as many as are asked for', () => {
    expect(program(Array(500).fill('G77').join('\n')).findings(20)).toHaveLength(20);
  });
});

/** All lines one after the other: what the pieces have to come to. */
function fromScratch(lines: readonly string[]) {
  let state = startState(ORIGIN);
  return lines.map((text) => {
    const block = readBlock(text);
    const found = { state, rules: findingsOf(block, state, PLAIN).map(({ rule }) => rule) };
    state = stateAfter(block, state);
    return found;
  });
}

describe('an edit', () => {
  it('leaves the same findings and states as reading all of it', () => {
    const splice = fc.record({
      at: fc.nat(700),
      removed: fc.nat(300),
      lines: fc.array(line, { maxLength: 200 }),
      checked: fc.nat(900),
    });
    fc.assert(
      fc.property(
        fc.array(line, { minLength: 1, maxLength: 600 }),
        fc.array(splice, { maxLength: 5 }),
        (first, edits) => {
          const lines = [...first];
          const source = { count: () => lines.length, line: (index: number) => lines[index]! };
          const made = new CncProgram(source, PLAIN, ORIGIN);
          made.check(400);
          for (const { at, removed, lines: inserted, checked } of edits) {
            const from = Math.min(at, lines.length - 1);
            const gone = Math.min(removed, lines.length - from);
            const added = gone === lines.length && inserted.length === 0 ? [''] : inserted;
            lines.splice(from, gone, ...added);
            made.edited(from, gone, added.length);
            made.check(checked);
            made.stateBefore(Math.min(checked, lines.length));
          }
          while (!made.check(50));
          const expected = fromScratch(lines);
          const global = new Set<Rule>(['sameNumber', 'noTarget']);
          const found = lines.map((): Rule[] => []);
          for (const one of made.findings()) if (!global.has(one.rule)) found[one.line]!.push(one.rule);
          expect(found).toEqual(expected.map(({ rules: all }) => all));
          for (const at of [0, 1, 127, 128, 300, lines.length - 1])
            if (at < lines.length) expect(made.stateBefore(at)).toEqual(expected[at]!.state);
        },
      ),
      { numRuns: 40 },
    );
  });

  it('reads a large program only where it touches it', () => {
    const lines = Array.from(
      { length: 100_000 },
      (_, at) => `N${String(at * 10)} G1 X${String(at % 97)} Y${String(at % 89)} F100`,
    );
    let reads = 0;
    const source = {
      count: () => lines.length,
      line: (index: number) => {
        reads++;
        return lines[index]!;
      },
    };
    const made = new CncProgram(source, PLAIN, ORIGIN);
    while (!made.check(10_000));
    reads = 0;
    lines.splice(500, 1, 'N1 G1 X7 Y7', 'N2 G77');
    made.edited(500, 1, 2);
    expect(made.check(5000)).toBe(true);
    expect(reads).toBeLessThan(1000);
    expect(made.findings().map(({ rule, line: at }) => [rule, at])).toEqual([['unknownCode', 501]]);
    expect(made.stateBefore(lines.length).position[0]).toBe(99_999 % 97);
  });
});
