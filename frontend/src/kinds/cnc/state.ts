/** What holds between two blocks: modal values and the position (cnc.md GC-06 to GC-12, GEO-01, GEO-21). */
import { arcOfAngle, arcOfCentre, arcOfRadius, pointOn, type Arc, type Point } from './arc';
import { actOf, AXES, codeOf, isTravel, RATES, type Act } from './gcodes';
import { valueOf, type Block } from './line';

/** Of all axes in the order of `AXES`; NaN where only the run decides. */
export type Position = readonly number[];

export interface State {
  /** Travel command that coordinates without one go on with. */
  readonly travel: number | null;
  /** G91. */
  readonly relative: boolean;
  /** G98. */
  readonly centresAbsolute: boolean;
  /** 15 to 19. */
  readonly plane: number;
  /** 40 to 42, with D. */
  readonly correction: number;
  readonly radius: number;
  /** 50 to 52, with D. */
  readonly corner: number;
  readonly distance: number;
  /** 60 or 61. */
  readonly loops: number;
  /** F, E (acceleration), E- (deceleration) and the like, where they were given. */
  readonly rates: Readonly<Record<string, number>>;
  /** Machine coordinates less programmed ones. */
  readonly offset: Position;
  /** Machine coordinates. */
  readonly position: Position;
}

export const ORIGIN: Position = [...AXES].map(() => 0);

export function startState(position: Position = ORIGIN): State {
  return {
    travel: null,
    relative: false,
    centresAbsolute: false,
    plane: 15,
    correction: 40,
    radius: 0,
    corner: 50,
    distance: 0,
    loops: 60,
    rates: {},
    offset: ORIGIN,
    position,
  };
}

/** Where a coordinate is without its offset. */
export function programmed(state: State): Position {
  return state.position.map((value, axis) => value - state.offset[axis]!);
}

/** The coordinates that a block names, by index of the axis; undefined elsewhere. */
export function coordinatesOf(block: Block): (number | undefined)[] {
  return [...AXES].map((axis) => valueOf(block, axis));
}

export function namesAxis(block: Block): boolean {
  return block.words.some(({ address }) => AXES.includes(address));
}

/** Where the axes are after a block that moves, in machine coordinates. */
function targetOf(block: Block, state: State): Position {
  return coordinatesOf(block).map((value, axis) => {
    const now = state.position[axis]!;
    if (value === undefined) return now;
    return state.relative ? now + value : value + state.offset[axis]!;
  });
}

/** The centre that I and J say, in machine coordinates. */
export function centreOf(block: Block, state: State): Point {
  const point = (letter: string, axis: number) => {
    const value = valueOf(block, letter) ?? 0;
    return value + (state.centresAbsolute ? state.offset[axis]! : state.position[axis]!);
  };
  return [point('I', 0), point('J', 1)];
}

/** The opening angle of an arc in degrees: T, in 2D also K (GEO-07). */
export function openingOf(block: Block, state: State): number | undefined {
  const angle = valueOf(block, 'T');
  if (angle !== undefined || state.plane !== 15) return angle;
  const bare = ['X', 'Y', 'R'].every((letter) => valueOf(block, letter) === undefined);
  return bare && valueOf(block, 'I') !== undefined ? valueOf(block, 'K') : undefined;
}

export function xy(position: Position): Point {
  return [position[0]!, position[1]!];
}

/** The arc of a G2 or G3 block in the X/Y plane; null where it becomes a line (GEO-05, GEO-06). */
export function arcOf(block: Block, state: State, code: number): Arc | null {
  const clockwise = code === 2;
  const start = xy(state.position);
  const angle = openingOf(block, state);
  if (angle !== undefined) return arcOfAngle(start, centreOf(block, state), angle, clockwise);
  const end = xy(targetOf(block, state));
  const radius = valueOf(block, 'R');
  if (radius !== undefined) return arcOfRadius(start, end, radius, clockwise);
  return arcOfCentre(start, end, centreOf(block, state), clockwise);
}

function moved(block: Block, state: State, code: number): Position {
  const target = targetOf(block, state);
  if ((code !== 2 && code !== 3) || openingOf(block, state) === undefined) return target;
  const arc = arcOf(block, state, code);
  if (arc === null) return target;
  const [x, y] = pointOn(arc, 1);
  return [x, y, ...target.slice(2)];
}

function ratesAfter(block: Block, rates: State['rates']): State['rates'] {
  let next = rates;
  for (const { address, value } of block.words) {
    if (!RATES.includes(address) || value.kind === 'none') continue;
    const number = value.kind === 'number' ? value.number : Number.NaN;
    const name = address === 'E' && number < 0 ? 'E-' : address;
    const amount = name === 'E-' ? -number : number;
    if (Object.is(next[name], amount)) continue;
    if (next === rates) next = { ...rates };
    (next as Record<string, number>)[name] = amount;
  }
  return next;
}

/** The state behind a block; a block that is suppressed changes nothing. */
export function stateAfter(block: Block, state: State, suppress = false): State {
  if (block.words.length === 0 || (suppress && block.skip)) return state;
  const act = actOf(block, state.travel);
  const rates = ratesAfter(block, state.rates);
  const base = rates === state.rates ? state : { ...state, rates };
  return carriedOut(block, base, act);
}

function carriedOut(block: Block, state: State, act: Act): State {
  const code = codeOf(act);
  if (code === null) return state;
  if (isTravel(code)) return { ...state, travel: code, position: moved(block, state, code) };
  const given = coordinatesOf(block);
  const d = valueOf(block, 'D') ?? 0;
  const offset = (of: (value: number, axis: number) => number): State => ({
    ...state,
    offset: state.offset.map((now, axis) => (given[axis] === undefined ? now : of(given[axis], axis))),
  });
  switch (code) {
    case 15:
    case 16:
    case 17:
    case 18:
    case 19:
      return { ...state, plane: code };
    case 40:
    case 41:
    case 42:
      return { ...state, correction: code, radius: code === 40 ? 0 : d };
    case 50:
    case 51:
    case 52:
      return { ...state, corner: code, distance: code === 50 ? 0 : d };
    case 53:
      return { ...state, offset: ORIGIN };
    case 54:
      return offset((value) => value);
    case 55:
      return offset((value, axis) => state.offset[axis]! + value);
    case 56:
      return offset((value, axis) => state.position[axis]! - value);
    case 60:
    case 61:
      return { ...state, loops: code };
    case 90:
    case 91:
      return { ...state, relative: code === 91 };
    case 92:
      return {
        ...state,
        position: state.position.map((now, axis) =>
          given[axis] === undefined ? now : given[axis] + state.offset[axis]!,
        ),
      };
    case 98:
    case 99:
      return { ...state, centresAbsolute: code === 98 };
    default:
      return state;
  }
}

/** Whether the same holds in both; then what was found behind one holds behind the other. */
export function sameState(a: State, b: State): boolean {
  if (a === b) return true;
  const rates = Object.keys(a.rates);
  return (
    a.travel === b.travel &&
    a.relative === b.relative &&
    a.centresAbsolute === b.centresAbsolute &&
    a.plane === b.plane &&
    a.correction === b.correction &&
    a.radius === b.radius &&
    a.corner === b.corner &&
    a.distance === b.distance &&
    a.loops === b.loops &&
    rates.length === Object.keys(b.rates).length &&
    rates.every((name) => Object.is(a.rates[name], b.rates[name])) &&
    a.offset.every((value, axis) => Object.is(value, b.offset[axis])) &&
    a.position.every((value, axis) => Object.is(value, b.position[axis]))
  );
}
