/** Why an operation cannot be carried out on a program (cnc.md CNC-86 to CNC-90). */
import { findingsOf, type Conditions } from '../checks';
import { actOf, codeOf } from '../gcodes';
import { readBlock, wordOf, type Block } from '../line';
import { startState, stateAfter, type Position, type State } from '../state';

export type Reason =
  'variables' | 'orientation' | 'plane' | 'jumps' | 'suppression' | 'faulty' | 'element' | 'spline' | 'shape' | 'unset';

/** Thrown by operations; `line` counts from 1. */
export class Refused extends Error {
  constructor(
    readonly reason: Reason,
    readonly line: number,
    readonly values: Readonly<Record<string, string>> = {},
  ) {
    super(`line ${String(line)}: ${reason}`);
  }
}

/** A block with the state that it begins in. */
export interface Step {
  readonly line: number;
  readonly block: Block;
  readonly state: State;
  /** Of the path, a mode or a shift; null for all others. */
  readonly code: number | null;
  readonly after: State;
}

/** The program block by block. Throws `Refused` where the checks for `reasons` fail, and for errors in any case. */
export function stepsOf(lines: readonly string[], start: Position, reasons: readonly Reason[]): Step[] {
  const conditions: Conditions = { velocity: 1, ready: false, suppress: false };
  let state = startState(start);
  return lines.map((text, index) => {
    const block = readBlock(text);
    const line = index + 1;
    const code = codeOf(actOf(block, state.travel));
    const why = reasons.find((reason) => TESTS[reason]?.(block, code, state) === true);
    if (why !== undefined) throw new Refused(why, line);
    if (findingsOf(block, state, conditions).some(({ severity }) => severity === 'error'))
      throw new Refused('faulty', line);
    const step = { line, block, state, code, after: stateAfter(block, state) };
    state = step.after;
    return step;
  });
}

const TESTS: Readonly<Partial<Record<Reason, (block: Block, code: number | null, state: State) => boolean>>> = {
  variables: (block) => block.words.some(({ value }) => value.kind === 'variable' || value.kind === 'expression'),
  orientation: (block) => ['A', 'B', 'C'].some((axis) => wordOf(block, axis) !== undefined),
  plane: (_, code) => code === 18 || code === 19,
  jumps: (_, code) => code !== null && [20, 36, 37].includes(code),
  suppression: (block) => block.skip,
};
