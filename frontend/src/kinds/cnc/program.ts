/**
 * A CNC program as lines whose meaning is known: read as they are asked for, and checked piece by piece.
 *
 * An edit costs what it touches: blocks are read again where the text changed, the state is followed on from there, and only
 * until it is what it was before. The text itself stays with its owner (`LineSource`); of a line only its block number and
 * what is wrong with it are kept, and the state before every `STRIDE`th.
 */
import { findingsOf, targetOfJump, type Conditions, type Finding } from './checks';
import { readBlock, wordOf, type Block } from './line';
import { sameState, startState, stateAfter, type Position, type State } from './state';

export interface LineSource {
  readonly count: () => number;
  /** A line from 0, without its break. */
  readonly line: (index: number) => string;
}

export interface PlacedFinding extends Finding {
  readonly line: number;
}

const STRIDE = 128;
/** Blocks that were read last; more than any screen shows. */
const MOST_BLOCKS = 4 * STRIDE;

interface Jump {
  readonly number: number;
  readonly at: number;
  readonly end: number;
}

interface Known {
  readonly findings: readonly Finding[];
  readonly number: number | null;
  readonly jump: Jump | null;
}

const NOTHING: Known = { findings: [], number: null, jump: null };

/** The state before a line. */
interface Checkpoint {
  line: number;
  readonly state: State;
}

export class CncProgram {
  private blocks = new Map<number, Block>();
  /** By line, about every `STRIDE`th. The first `valid` hold; the others did before an edit. */
  private checkpoints: Checkpoint[];
  private valid = 1;
  private known: Known[];
  /** All lines before this one have been checked. */
  private unchecked = 0;
  /** From this line on what is known is true wherever the state is that of the checkpoint there. */
  private untouched: number;
  /** The state that was asked for last. */
  private memo: Checkpoint | null = null;

  constructor(
    private readonly source: LineSource,
    private conditions: Conditions,
    start: Position,
  ) {
    this.checkpoints = [{ line: 0, state: startState(start) }];
    this.known = new Array<Known>(source.count()).fill(NOTHING);
    this.untouched = source.count();
  }

  /** Lines, as far as `edited` was told. */
  get count(): number {
    return this.known.length;
  }

  /** All lines have been checked. */
  get settled(): boolean {
    return this.unchecked >= this.count;
  }

  block(line: number): Block {
    const text = this.source.line(line);
    const read = this.blocks.get(line);
    if (read?.text === text) return read;
    if (this.blocks.size >= MOST_BLOCKS) this.blocks.clear();
    const block = readBlock(text);
    this.blocks.set(line, block);
    return block;
  }

  /** What holds before a line; behind the last one for `count`. */
  stateBefore(line: number): State {
    const base = this.checkpoints[checkpointAt(this.checkpoints, this.valid, line)]!;
    const from = this.memo !== null && this.memo.line <= line && this.memo.line > base.line ? this.memo : base;
    let { state } = from;
    for (let index = from.line; index < line; index++)
      state = stateAfter(this.passing(index), state, this.conditions.suppress);
    this.memo = { line, state };
    return state;
  }

  /** Lines `from` to `from + removed - 1` have become `inserted` others. */
  edited(from: number, removed: number, inserted: number): void {
    const { settled } = this;
    const moved = inserted - removed;
    const behind = from + removed;
    const shifted = (line: number) => (line >= behind ? line + moved : Math.min(line, from + inserted));
    this.known = [
      ...this.known.slice(0, from),
      ...new Array<Known>(inserted).fill(NOTHING),
      ...this.known.slice(behind),
    ];
    // What was followed on after an earlier edit does not lead to what stands behind that.
    const frontier = settled ? 0 : shifted(Math.max(this.untouched, this.unchecked));
    this.untouched = Math.max(frontier, from + inserted);
    this.unchecked = Math.min(this.unchecked, from);
    this.valid = Math.min(this.valid, checkpointAt(this.checkpoints, this.checkpoints.length, from) + 1);
    this.checkpoints = this.checkpoints.filter(({ line }) => line <= from || line >= behind);
    for (const one of this.checkpoints.slice(this.valid)) one.line += moved;
    this.blocks.clear();
    this.memo = null;
  }

  /** Other properties: all is checked again. */
  under(conditions: Conditions, start: Position): void {
    this.conditions = conditions;
    this.checkpoints = [{ line: 0, state: startState(start) }];
    this.valid = 1;
    this.unchecked = 0;
    this.untouched = this.count;
    this.memo = null;
  }

  /** Checks up to `lines` more; true when all are. */
  check(lines: number): boolean {
    const end = Math.min(this.count, this.unchecked + lines);
    let state = this.stateBefore(this.unchecked);
    for (let line = this.unchecked; line < end; line++) {
      if (this.arrive(line, state)) {
        this.valid = this.checkpoints.length;
        this.unchecked = this.count;
        return true;
      }
      const block = this.passing(line);
      this.known[line] = knownOf(block, findingsOf(block, state, this.conditions));
      state = stateAfter(block, state, this.conditions.suppress);
    }
    this.unchecked = end;
    if (this.settled) this.checkpoints.length = this.valid;
    return this.settled;
  }

  /** Notes the state before a line; true where it is what it was, and so all behind it. */
  private arrive(line: number, state: State): boolean {
    const next = this.checkpoints[this.valid];
    if (next?.line === line) {
      if (line >= this.untouched && sameState(next.state, state)) return true;
      this.checkpoints[this.valid++] = { line, state };
    } else if (line - this.checkpoints[this.valid - 1]!.line >= STRIDE)
      this.checkpoints.splice(this.valid++, 0, { line, state });
    return false;
  }

  /** What is wrong with the lines that have been checked, at most so much of it, in their order. */
  findings(most = Number.POSITIVE_INFINITY): PlacedFinding[] {
    const numbers = new Map<number, number>();
    this.known.forEach(({ number }, line) => {
      if (number !== null && !numbers.has(number)) numbers.set(number, line);
    });
    const found: PlacedFinding[] = [];
    for (let line = 0; line < this.unchecked && found.length < most; line++) {
      const { findings, number, jump } = this.known[line]!;
      for (const one of findings) found.push({ ...one, line });
      if (number !== null && numbers.get(number) !== line) {
        const { at, end } = wordOf(this.block(line), 'N') ?? { at: 0, end: 0 };
        const first = String(numbers.get(number)! + 1);
        found.push({
          rule: 'sameNumber',
          severity: 'warning',
          at,
          end,
          line,
          values: { number: String(number), first },
        });
      }
      // Whether a number is missing is known when all lines have been read.
      if (jump !== null && this.settled && !numbers.has(jump.number))
        found.push({ rule: 'noTarget', severity: 'error', ...jump, line, values: { number: String(jump.number) } });
    }
    return found.slice(0, most);
  }

  /** Block numbers in the order of the lines; null where a line has none. */
  *numbers(): Iterable<number | null> {
    for (let line = 0; line < this.count; line++) yield this.known[line]?.number ?? this.block(line).number;
  }

  /** Reads a line without keeping it: the program is passed once, from its beginning to its end. */
  private passing(line: number): Block {
    return this.blocks.get(line) ?? readBlock(this.source.line(line));
  }
}

/** The last of the first `count` checkpoints that is at or before a line. */
function checkpointAt(checkpoints: readonly Checkpoint[], count: number, line: number): number {
  let low = 0;
  let high = count - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (checkpoints[middle]!.line <= line) low = middle;
    else high = middle - 1;
  }
  return low;
}

function knownOf(block: Block, findings: readonly Finding[]): Known {
  const target = targetOfJump(block);
  if (findings.length === 0 && block.number === null && target === null) return NOTHING;
  const jump = target && { number: target.number, at: target.word.at, end: target.word.end };
  return { findings, number: block.number, jump };
}

/** The lines of a text. */
export function linesOf(text: string): LineSource {
  const lines = text.split('\n');
  return { count: () => lines.length, line: (index) => lines[index] ?? '' };
}
