/** Edits of the program by dragging in its graphic: one step of the undo stack a drag (CNC-57). */
import type { CncDocument } from '../cncDocument';
import { lineEdit } from '../edits';
import type { Block } from '../line';
import type { State } from '../state';
import { movableEnd, movableTangents, rounded, withEnd, withTangent } from './dragging';
import type { Grip } from './PathOverlay';
import {
  facingPlane,
  onPlane,
  pixelSize,
  rayThrough,
  type Eye,
  type Frame,
  type Seen,
  type Vector,
} from './projection';

export class PathDrag {
  /** As they were when the drag began: each step counts from there, so that nothing adds up. */
  private readonly block: Block;
  private readonly state: State;

  constructor(
    private readonly program: CncDocument,
    private readonly grip: Grip,
  ) {
    this.block = program.program.block(grip.line);
    this.state = program.program.stateBefore(grip.line);
    program.closeStep();
  }

  /** Takes the grip to a point of the screen, in the plane that the camera sees most of. */
  to(at: Seen, eye: Eye, frame: Frame): void {
    const ray = rayThrough(eye, frame, at);
    const normal = this.grip.kind === 'end' ? facingPlane(ray) : ([0, 0, 1] as const);
    const base = this.grip.kind === 'tangent' && this.grip.at === 'end' ? this.grip.end : this.grip.from;
    const met = onPlane(ray, base, normal);
    if (met === null) return;
    const text = this.textFor(met, base, normal, pixelSize(eye, frame, base));
    if (text !== null) this.program.apply([lineEdit(this.grip.line, text)], 'joined');
  }

  private textFor(met: Vector, base: Vector, normal: Vector, grain: number): string | null {
    if (this.grip.kind === 'end') {
      const place = met.map((value, axis) => (normal[axis] === 1 ? base[axis]! : rounded(value, grain)));
      return withEnd(this.block, this.state, place as unknown as Vector);
    }
    const sign = this.grip.at === 'start' ? 1 : -1;
    const way = [sign * (met[0] - base[0]), sign * (met[1] - base[1])] as const;
    return withTangent(this.block, this.state, this.grip.at, way);
  }

  /** Ends the step of the undo stack. */
  drop(): void {
    this.program.closeStep();
  }
}

export function canMoveEnd({ program }: CncDocument, line: number): boolean {
  return line >= 0 && line < program.count && movableEnd(program.block(line), program.stateBefore(line)) !== null;
}

export function canMoveTangents({ program }: CncDocument, line: number): boolean {
  return line >= 0 && line < program.count && movableTangents(program.block(line), program.stateBefore(line));
}
