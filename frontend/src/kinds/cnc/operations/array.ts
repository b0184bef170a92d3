/** Repeats a program in columns along X and rows along Y. */
import { appliedTo, type LinesEdit } from '../edits';
import { AXES } from '../gcodes';
import { programmed, type Position } from '../state';
import { renumbered } from './renumber';
import { stepsOf } from './refusal';
import { firstMove, movedBlocks, velocityFor, wordsOf } from './transform';

export interface ArrayShape {
  readonly columns: number;
  readonly rows: number;
  /** Between columns along X, between rows along Y. */
  readonly dx: number;
  readonly dy: number;
}

export const MOST_COPIES = 1000;

/** The program followed by its copies, row by row; each begins with a positioning to its start, in absolute coordinates. */
export function arrayedProgram(
  lines: readonly string[],
  start: Position,
  shape: ArrayShape,
  velocity: number,
): LinesEdit[] {
  const steps = stepsOf(lines, start, ['variables', 'orientation', 'jumps']);
  const first = firstMove(steps);
  const last = steps.at(-1);
  if (first === undefined || last === undefined) return [];
  const end = lines.at(-1) === '' ? lines.length - 1 : lines.length;
  const body = steps.slice(0, end);
  const begin = programmed(first.state);
  const modes = backToStart(last.after, first.state);
  const copies: string[] = [];
  for (let row = 0; row < shape.rows; row++)
    for (let column = 0; column < shape.columns; column++) {
      if (row === 0 && column === 0) continue;
      const vector = [...AXES].map((_, axis) => [column * shape.dx, row * shape.dy][axis] ?? 0);
      const target = Object.fromEntries(
        [...AXES].flatMap((letter, axis) =>
          axis < 2 || last.after.position[axis] !== first.state.position[axis]
            ? [[letter, begin[axis]! + vector[axis]!]]
            : [],
        ),
      ) as Record<string, number>;
      copies.push(...modes, `G0 ${wordsOf(target)}${velocityFor(first, velocity)}`);
      if (first.state.relative) copies.push('G91');
      copies.push(...movedBlocks(body, vector));
    }
  const all = [...lines.slice(0, end), ...copies, ...lines.slice(end)];
  const numbered = body.some(({ block }) => block.number !== null) ? appliedTo(all, renumbered(all)) : all;
  return [{ from: 0, removed: lines.length, lines: numbered }];
}

/** Blocks that bring back the modes that the program begins in; the copy finds what the original found. */
function backToStart(after: ReturnType<typeof stepsOf>[number]['after'], before: typeof after): string[] {
  const changed = (name: 'plane' | 'correction' | 'corner' | 'loops') =>
    after[name] !== before[name] ? [`G${String(before[name])}`] : [];
  return [
    ...changed('plane'),
    ...changed('correction'),
    ...changed('corner'),
    ...changed('loops'),
    ...(after.centresAbsolute !== before.centresAbsolute ? [before.centresAbsolute ? 'G98' : 'G99'] : []),
    ...(after.offset.some((value, axis) => value !== before.offset[axis]) ? ['G53'] : []),
    ...(after.relative ? ['G90'] : []),
  ];
}
