/** What is wrong with a block, from its words and what holds before it (cnc.md CNC-35, CNC-37, GC-02 to GC-09, GEO-05). */
import {
  actOf,
  ADDRESSES,
  codeOf,
  G_CODES,
  isTravel,
  type GCode,
  lettersOf,
  LIMITLESS,
  MODAL,
  MOST_SWITCHES,
  type Act,
} from './gcodes';
import { valueOf, wordOf, type Block, type Word } from './line';
import { arcOf, namesAxis, openingOf, type State } from './state';

export type Rule =
  | 'unknownLetter'
  | 'unknownCode'
  | 'missingValue'
  | 'noWord'
  | 'openComment'
  | 'whole'
  | 'notTaken'
  | 'needs'
  | 'needsCentre'
  | 'twoCommands'
  | 'twice'
  | 'noTravel'
  | 'manySwitches'
  | 'switchPlace'
  | 'extension'
  | 'blockNumber'
  | 'sameNumber'
  | 'noTarget'
  | 'noVelocity'
  | 'noArc'
  | 'variables'
  | 'openingAngle'
  | 'probe'
  | 'probeSwitch'
  | 'numberRange';

export interface Finding {
  readonly rule: Rule;
  readonly severity: 'error' | 'warning';
  /** Characters of the line. */
  readonly at: number;
  readonly end: number;
  readonly values: Readonly<Record<string, string>>;
}

/** What of the properties of the program counts for messages. */
export interface Conditions {
  /** Of elements without F. */
  readonly velocity: number;
  /** Variables have the values that they begin with (CNC-35). */
  readonly ready: boolean;
  /** Blocks with / are left out. */
  readonly suppress: boolean;
}

const MOST_PROBES = 32_767;
const LARGEST_ANGLE = 1080;
const WHOLE: ReadonlySet<string> = new Set(['G', 'M', 'H']);

function finding(rule: Rule, at: { at: number; end: number }, values: Finding['values'] = {}): Finding {
  return { rule, severity: 'error', at: at.at, end: at.end, values };
}
function warning(rule: Rule, at: { at: number; end: number }, values: Finding['values'] = {}): Finding {
  return { ...finding(rule, at, values), severity: 'warning' };
}

/** An address that is asked whether the command takes it: modal ones stand anywhere, of others another message tells. */
function isKnown(address: string): boolean {
  return ADDRESSES.has(address) && !MODAL.has(address) && !LIMITLESS.has(address) && address !== 'PROBE';
}

/** What a command is called: `G1`, `M`. */
export function nameOfAct(act: Act): string {
  const code = codeOf(act);
  return code === null ? 'M' : `G${String(code)}`;
}

/** All that is wrong with a block that begins in a state. */
export function findingsOf(block: Block, state: State, conditions: Conditions): Finding[] {
  const found = [...tokenFindings(block), ...wordFindings(block)];
  if (conditions.suppress && block.skip) return found;
  const act = actOf(block, state.travel);
  return [...found, ...commandFindings(block, act), ...pathFindings(block, state, act, conditions)];
}

function tokenFindings(block: Block): Finding[] {
  return block.tokens.flatMap((token): Finding[] => {
    const text = block.text.slice(token.at, token.end);
    if (token.kind === 'other') return [finding('noWord', token, { text })];
    if (token.kind === 'statement') return [finding('extension', token, { name: /^\w+/.exec(text)?.[0] ?? text })];
    if (token.kind === 'comment' && text.startsWith('(') && !text.endsWith(')')) return [finding('openComment', token)];
    return [];
  });
}

function wordFindings(block: Block): Finding[] {
  return block.words.flatMap((word): Finding[] => {
    const { address, value } = word;
    if (!ADDRESSES.has(address) || LIMITLESS.has(address)) return [finding('unknownLetter', word, { letter: address })];
    if (value.kind === 'none') return [finding('missingValue', word, { letter: address })];
    if (value.kind === 'expression') return [finding('extension', word, { name: block.text.slice(word.at, word.end) })];
    if (address === 'N')
      return block.number === null || word.at !== firstNumber(block) ? [finding('blockNumber', word)] : [];
    if (value.kind === 'number' && WHOLE.has(address) && !Number.isInteger(value.number))
      return [finding('whole', word, { letter: address })];
    return [];
  });
}

/** Where the block number may stand: in front of all other words. */
function firstNumber(block: Block): number {
  return block.words[0]?.address === 'N' ? block.words[0].at : -1;
}

function commandFindings(block: Block, act: Act): Finding[] {
  const commands = block.words.filter(({ address }) => address === 'G' || address === 'M');
  const found: Finding[] = commands.slice(1).map((word) => finding('twoCommands', word));
  const first = commands[0];
  const code = codeOf(act);
  const known = code === null ? undefined : G_CODES.get(code);
  if (first?.address === 'G' && code !== null && Number.isInteger(code)) {
    if (known === undefined) return [...found, finding('unknownCode', first, { code: String(code) })];
  }
  if (act.kind === 'unknown' && first === undefined) found.push(finding('noTravel', range(block)));
  const letters = lettersOf(act);
  if (letters !== null)
    for (const word of block.words)
      if (!'GMN'.includes(word.address) && isKnown(word.address) && !letters.has(word.address))
        found.push(finding('notTaken', word, { letter: word.address, command: nameOfAct(act) }));
  const needs = known?.needs ?? [];
  const moves = block.words.some(({ address }) => !'GMN'.includes(address) && !MODAL.has(address));
  if (
    needs.length > 0 &&
    act.kind === 'g' &&
    needs.every((letter) => wordOf(block, letter) === undefined) &&
    (moves || known?.travels !== true)
  )
    found.push(
      code === 2 || code === 3
        ? finding('needsCentre', first ?? range(block), { command: nameOfAct(act) })
        : finding('needs', first ?? range(block), { command: nameOfAct(act), letters: needs.join(' / ') }),
    );
  if (known) found.push(...probeFindings(block, known), ...rangeFindings(block, known));
  return [...found, ...repeated(block), ...(act.kind === 'm' ? [] : switchFindings(block, code))];
}

/** Probes have a number; some commands end where their signal comes, and have no switch points then. */
function probeFindings(block: Block, known: GCode): Finding[] {
  const probe = wordOf(block, 'PROBE');
  if (probe === undefined) return [];
  const command = `G${String(known.code)}`;
  if (!known.probes) return [finding('notTaken', probe, { letter: 'PROBE', command })];
  const { value } = probe;
  const isNumber =
    value.kind !== 'number' || (Number.isInteger(value.number) && value.number >= 1 && value.number <= MOST_PROBES);
  const wrong = isNumber ? [] : [finding('probe', probe, { most: String(MOST_PROBES) })];
  const switches = block.words.filter(({ address }) => address === 'H' && known.letters.has('H'));
  return [...wrong, ...switches.map((word) => finding('probeSwitch', word))];
}

/** L that is no flag or no axis. */
function rangeFindings(block: Block, { code, numbers }: GCode): Finding[] {
  const word = wordOf(block, 'L');
  const [first, last] = numbers ?? [];
  if (first === undefined || last === undefined || word?.value.kind !== 'number') return [];
  const { number } = word.value;
  if (Number.isInteger(number) && number >= first && number <= last) return [];
  return [finding('numberRange', word, { command: `G${String(code)}`, first: String(first), last: String(last) })];
}

/** E may stand twice with other signs (GC-05); H, L and O go together as switch points; two commands have their own words. */
function repeated(block: Block): Finding[] {
  const seen = new Set<string>();
  return block.words.flatMap((word): Finding[] => {
    const { address, value } = word;
    if ('GMHLO'.includes(address)) return [];
    const falling = address === 'E' && value.kind === 'number' && value.number < 0;
    const key = falling ? 'E-' : address;
    if (seen.has(key)) return [finding('twice', word, { letter: key })];
    seen.add(key);
    return [];
  });
}

function switchFindings(block: Block, code: number | null): Finding[] {
  const words = block.words.filter(({ address }) => 'HLO'.includes(address) && address.length === 1);
  const switches = words.filter(({ address }) => address === 'H');
  if (switches.length === 0)
    return code !== null && isTravel(code)
      ? words.slice(0, 1).map((word) => finding('switchPlace', word, { letter: word.address }))
      : [];
  const placed = (word: Word) => words[words.indexOf(word) + 1]?.address !== 'H' && word !== words.at(-1);
  return [
    ...switches.slice(MOST_SWITCHES).map((word) => finding('manySwitches', word, { most: String(MOST_SWITCHES) })),
    ...switches.filter((word) => !placed(word)).map((word) => finding('switchPlace', word, { letter: 'H' })),
  ];
}

function pathFindings(block: Block, state: State, act: Act, conditions: Conditions): Finding[] {
  const found: Finding[] = [];
  const code = codeOf(act);
  if (conditions.ready)
    for (const word of block.words)
      if (word.value.kind === 'variable') found.push(warning('variables', word, { name: word.value.name }));
  if (code === null || !isTravel(code)) return found;
  const moves = namesAxis(block) || openingOf(block, state) !== undefined || wordOf(block, 'I') !== undefined;
  if (moves) {
    const own = code === 0 ? (valueOf(block, 'FF') ?? (state.rates['FF'] || undefined)) : undefined;
    const velocity = own ?? valueOf(block, 'F') ?? state.rates['F'] ?? conditions.velocity;
    if (velocity === 0) found.push(warning('noVelocity', range(block)));
  }
  if (code !== 2 && code !== 3) return found;
  const angle = openingOf(block, state);
  if (angle !== undefined && Math.abs(angle) > LARGEST_ANGLE)
    found.push(finding('openingAngle', wordOf(block, 'T') ?? range(block), { most: String(LARGEST_ANGLE) }));
  const round = ['R', 'I', 'J', 'T'].some((letter) => wordOf(block, letter));
  const known =
    state.position.slice(0, 2).every(Number.isFinite) && block.words.every(({ value }) => value.kind === 'number');
  if (state.plane === 15 && round && known && arcOf(block, state, code) === null)
    found.push(warning('noArc', range(block), { command: nameOfAct(act) }));
  return found;
}

/** From the first to the last word of a block. */
function range(block: Block): { at: number; end: number } {
  return { at: block.words[0]?.at ?? 0, end: block.words.at(-1)?.end ?? block.text.length };
}

/** The jump target of a block. */
export function targetOfJump(block: Block): { word: Word; number: number } | null {
  const command = wordOf(block, 'G')?.value;
  if (command?.kind !== 'number' || command.number !== 20) return null;
  const word = wordOf(block, 'L');
  return word?.value.kind === 'number' ? { word, number: word.value.number } : null;
}
