/** Quick fixes of what is wrong with a block; each is an edit of whole lines. */
import type { PlacedFinding, CncProgram } from './program';
import { cutOut, lineEdit, replaced, withWord, type LinesEdit } from './edits';
import { actOf, G_CODES, type Act } from './gcodes';
import { wordOf, type Block, type Word } from './line';

export interface Fix {
  /** Ending of a key `cnc.fix.…`. */
  readonly name: 'change' | 'remove' | 'insert' | 'join' | 'split' | 'close' | 'number' | 'comma';
  readonly values: Readonly<Record<string, string>>;
  readonly edits: readonly LinesEdit[];
}

/** How many single changes lead from one text to another (Levenshtein). */
export function distance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, at) => at);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++)
      next[j] = Math.min(row[j]! + 1, next[j - 1]! + 1, row[j - 1]! + (a[i - 1] === b[j - 1] ? 0 : 1));
    row = next;
  }
  return row[b.length]!;
}

/** The known codes that look most like a number that is none. */
export function likelyCodes(written: string): number[] {
  const codes = [...G_CODES.keys()];
  const ranked = codes.map((code) => ({ code, far: distance(written, String(code)) }));
  const least = Math.min(...ranked.map(({ far }) => far));
  return least > 1
    ? []
    : ranked
        .filter(({ far }) => far === least)
        .map(({ code }) => code)
        .slice(0, 3);
}

/** The next number of the usual step that no block has. */
export function freeNumber(program: CncProgram, step = 10): number {
  let most = -step;
  for (const number of program.numbers()) if (number !== null && number > most) most = number;
  return (Math.floor(most / step) + 1) * step;
}

/** All that can be done about a finding, the likeliest first. */
export function fixesOf(program: CncProgram, found: PlacedFinding): Fix[] {
  const block = program.block(found.line);
  const word = block.words.find(({ at, end }) => at === found.at && end === found.end);
  const text = block.text.slice(found.at, found.end);
  const change = (by: string, at = found.at, end = found.end): Fix => ({
    name: 'change',
    values: { text: block.text.slice(at, end), by },
    edits: [lineEdit(found.line, replaced(block.text, at, end, by))],
  });
  const remove = (): Fix => ({
    name: 'remove',
    values: { text },
    edits: [lineEdit(found.line, cutOut(block.text, found.at, found.end))],
  });
  const insert = (address: string, value: string): Fix => ({
    name: 'insert',
    values: { text: address + value },
    edits: [lineEdit(found.line, withWord(block, address, value))],
  });
  switch (found.rule) {
    case 'unknownCode':
      return [...likelyCodes(found.values['code'] ?? '').map((code) => change(`G${String(code)}`)), remove()];
    case 'whole':
      return word === undefined ? [] : [change(word.address + String(Math.round(numberOf(word)))), remove()];
    case 'missingValue':
      return word === undefined ? [] : [...valueFixes(block, word, found.line), remove()];
    case 'noWord':
      return [...commaFix(block, found), remove()];
    case 'notTaken':
    case 'twice':
    case 'manySwitches':
    case 'unknownLetter':
    case 'probe':
    case 'probeSwitch':
    case 'numberRange':
    case 'variables':
      return [remove()];
    case 'openComment':
      return [{ name: 'close', values: {}, edits: [lineEdit(found.line, `${block.text.trimEnd()})`)] }];
    case 'twoCommands':
      return splitFix(block, word, found.line);
    case 'noTravel':
      return [insert('G', '1'), insert('G', '0')];
    case 'needs':
      return neededFixes(block, actOf(block, null), found.line);
    case 'needsCentre':
      return [insert('R', '10')];
    case 'switchPlace':
      return word?.address === 'H' ? [insert('O', '0.5'), remove()] : [remove()];
    case 'sameNumber':
      return [{ ...change(`N${String(freeNumber(program))}`), name: 'number' }];
    case 'blockNumber':
      return [remove()];
    case 'noTarget':
      return nearestNumbers(program, Number(found.values['number'])).map((number) => change(`L${String(number)}`));
    case 'noVelocity':
      return [insert('F', '100')];
    case 'extension':
    case 'noArc':
    case 'openingAngle':
      return [];
  }
}

function numberOf(word: Word): number {
  return word.value.kind === 'number' ? word.value.number : 0;
}

/** `X 10` and `GO1` with a letter O for a zero are meant as one word; anything else begins with 0. */
function valueFixes(block: Block, word: Word, line: number): Fix[] {
  const behind = /^\s+([+-]?(?:\d+\.?\d*|\.\d+))/.exec(block.text.slice(word.end));
  if (behind !== null)
    return [
      {
        name: 'join',
        values: { text: word.address + behind[1]! },
        edits: [lineEdit(line, replaced(block.text, word.end, word.end + behind[0].length, behind[1]!))],
      },
    ];
  const misread = /^[OolI]+\d*/.exec(block.text.slice(word.end));
  if (word.address === 'G' && misread !== null) {
    const digits = misread[0].replace(/[Oo]/g, '0').replace(/[lI]/g, '1');
    const code = Number(digits);
    if (G_CODES.has(code))
      return [
        {
          name: 'change',
          values: { text: `G${misread[0]}`, by: `G${String(code)}` },
          edits: [lineEdit(line, replaced(block.text, word.at, word.end + misread[0].length, `G${String(code)}`))],
        },
      ];
  }
  return [
    {
      name: 'insert',
      values: { text: `${word.address}0` },
      edits: [lineEdit(line, replaced(block.text, word.end, word.end, '0'))],
    },
  ];
}

/** `X10,5` has a decimal comma. */
function commaFix(block: Block, found: PlacedFinding): Fix[] {
  const { text } = block;
  const comma = /^,(\d+)/.exec(text.slice(found.at));
  if (comma === null || !/\d$/.test(text.slice(0, found.at))) return [];
  return [{ name: 'comma', values: {}, edits: [lineEdit(found.line, replaced(text, found.at, found.at + 1, '.'))] }];
}

/** Each command in a block of its own; coordinates stay with the one in front of them. */
function splitFix(block: Block, second: Word | undefined, line: number): Fix[] {
  if (second === undefined) return [];
  const first = block.text.slice(0, second.at).trimEnd();
  return [
    { name: 'split', values: {}, edits: [{ from: line, removed: 1, lines: [first, block.text.slice(second.at)] }] },
  ];
}

function neededFixes(block: Block, act: Act, line: number): Fix[] {
  if (act.kind !== 'g') return [];
  const missing = (G_CODES.get(act.code)?.needs ?? []).filter((letter) => wordOf(block, letter) === undefined);
  const value = { T: '1', D: '1' };
  const words = missing.map((letter) => letter + (value[letter as 'T' | 'D'] ?? '0'));
  const end = block.words.at(-1)?.end ?? block.text.length;
  return [
    {
      name: 'insert',
      values: { text: words.join(' ') },
      edits: [lineEdit(line, replaced(block.text, end, end, ` ${words.join(' ')}`))],
    },
  ];
}

/** The block numbers next to one that there is not. */
function nearestNumbers(program: CncProgram, wanted: number): number[] {
  const numbers = [...new Set([...program.numbers()].filter((number) => number !== null))];
  return numbers.sort((a, b) => Math.abs(a - wanted) - Math.abs(b - wanted)).slice(0, 2);
}
